// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Progress.h"

#include "Errors.h"
#include "Signals.h"
#include "Terminal.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <iostream>

namespace medialvoxel
{
namespace
{

using Clock = std::chrono::steady_clock;

std::string
FormatDuration(double seconds)
{
  const auto           whole = static_cast<long long>(std::max(0.0, seconds) + 0.5);
  std::array<char, 32> text{};
  if (whole >= 3600)
  {
    std::snprintf(text.data(), text.size(), "%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60, whole % 60);
  }
  else
  {
    std::snprintf(text.data(), text.size(), "%lld:%02lld", whole / 60, whole % 60);
  }
  return text.data();
}

/** Time since the start, and an estimate of the rest. */
class Stopwatch
{
public:
  void
  Start()
  {
    m_Start = Clock::now();
  }

  double
  GetSeconds() const
  {
    return std::chrono::duration<double>(Clock::now() - m_Start).count();
  }

  std::string
  FormatTimeLeft(double fraction) const
  {
    constexpr double leastFraction = 0.01;
    return fraction < leastFraction ? "-:--" : FormatDuration(this->GetSeconds() * (1.0 - fraction) / fraction);
  }

private:
  Clock::time_point m_Start{ Clock::now() };
};

/** Base of the sinks whose notes are lines on the error stream. */
class TextSink : public ProgressSink
{
public:
  void
  Note(const std::string & text) override
  {
    std::cerr << "medialvoxel: " << text << std::endl;
  }
};

/** Base of the sinks that show where the work is at most so often. */
class TimedSink : public TextSink
{
public:
  void
  Start(const std::string & name, const std::string &) override
  {
    m_Name = name;
    m_Stopwatch.Start();
  }

  void
  Report(double fraction) override
  {
    m_Fraction = fraction;
    this->Heartbeat();
  }

  void
  Heartbeat() override
  {
    const double now = m_Stopwatch.GetSeconds();
    if (now - m_LastTime >= m_Interval)
    {
      m_LastTime = now;
      this->Show(m_Fraction);
    }
  }

protected:
  explicit TimedSink(double seconds)
    : m_Interval(seconds)
  {}

  virtual void
  Show(double fraction) = 0;

  const std::string &
  GetName() const
  {
    return m_Name;
  }

  const Stopwatch &
  GetStopwatch() const
  {
    return m_Stopwatch;
  }

private:
  double      m_Interval;
  std::string m_Name;
  Stopwatch   m_Stopwatch;
  double      m_Fraction{ 0.0 };
  double      m_LastTime{ 0.0 };
};

class BarSink : public TimedSink
{
public:
  BarSink()
    : TimedSink(0.1)
  {}

  ~BarSink() override
  {
    // The next output, perhaps a message, begins on a clean line.
    this->WipeOut();
  }

  void
  Note(const std::string & text) override
  {
    this->WipeOut();
    TimedSink::Note(text);
  }

  void
  Start(const std::string & name, const std::string & comment) override
  {
    TimedSink::Start(name, comment);
    this->Show(0.0);
  }

protected:
  /** A wrapped line could not be drawn over, so parts that do not fit are left out, the bar first. */
  void
  Show(double fraction) override
  {
    constexpr int     longest = 40;
    constexpr int     shortest = 5;
    const std::string percent = std::to_string(static_cast<int>(fraction * 100)) + " %";
    const std::string text = percent + ", " + this->GetStopwatch().FormatTimeLeft(fraction) + " left";
    const int         columns = GetTerminalColumns() - 1;
    const int         rest = columns - static_cast<int>(this->GetName().size() + text.size() + std::strlen(" [] "));
    const int         width = std::min(longest, rest);
    const int         filled = std::clamp(static_cast<int>(fraction * width), 0, std::max(width, 0));
    const std::string bar = width < shortest ? "" : std::string(filled, '#') + std::string(width - filled, '.');
    const std::string line = bar.empty() ? text : this->GetName() + " [" + bar + "] " + text;
    const auto        fits = [columns](const std::string & shown) { return static_cast<int>(shown.size()) <= columns; };
    std::cerr << '\r' << (fits(line) ? line : fits(percent) ? percent : "") << "\033[K" << std::flush;
    m_Drawn = true;
  }

private:
  void
  WipeOut()
  {
    if (m_Drawn)
    {
      std::cerr << "\r\033[K" << std::flush;
    }
  }

  bool m_Drawn{ false };
};

class PlainSink : public TimedSink
{
public:
  PlainSink()
    : TimedSink(30.0)
  {}

protected:
  void
  Show(double fraction) override
  {
    const Stopwatch & stopwatch = this->GetStopwatch();
    std::cerr << this->GetName() << ": " << static_cast<int>(fraction * 100) << " % after "
              << FormatDuration(stopwatch.GetSeconds()) << ", " << stopwatch.FormatTimeLeft(fraction) << " left"
              << std::endl;
  }
};

/** Base of the sinks that write a line for each percent, and the last one again when a second has passed. */
class PercentSink : public TextSink
{
public:
  void
  Report(double fraction) override
  {
    const int percent = std::clamp(static_cast<int>(fraction * 100), 0, 99);
    if (percent > m_Percent)
    {
      m_Percent = percent;
      this->WritePercent();
    }
    this->Heartbeat();
  }

  void
  Heartbeat() override
  {
    constexpr double secondsBetweenLines = 1.0;
    if (m_Percent >= 0 && m_SinceLine.GetSeconds() >= secondsBetweenLines)
    {
      this->WritePercent();
    }
  }

protected:
  virtual void
  WriteLine(double fraction) = 0;

private:
  void
  WritePercent()
  {
    m_SinceLine.Start();
    this->WriteLine(m_Percent / 100.0);
  }

  int       m_Percent{ -1 };
  Stopwatch m_SinceLine;
};

class SlicerSink : public PercentSink
{
public:
  void
  Start(const std::string & name, const std::string & comment) override
  {
    m_Name = name;
    std::cout << "<filter-start><filter-name>" << name << "</filter-name><filter-comment>" << comment
              << "</filter-comment></filter-start>" << std::endl;
  }

  void
  Finish(double seconds) override
  {
    this->WriteLine(1.0);
    std::cout << "<filter-end><filter-name>" << m_Name << "</filter-name><filter-time>" << seconds
              << "</filter-time></filter-end>" << std::endl;
  }

  /** 3D Slicer takes whatever is on the error stream for an error. */
  void
  Note(const std::string & text) override
  {
    std::cout << "medialvoxel: " << text << std::endl;
  }

  /** The comment is shown while the module runs; the line stays in the log. */
  void
  Warn(const std::string & code, const std::string & message) override
  {
    PercentSink::Warn(code, message);
    std::cout << "<filter-comment>Warning: " << message << "</filter-comment>" << std::endl;
  }

protected:
  void
  WriteLine(double fraction) override
  {
    std::cout << "<filter-progress>" << fraction << "</filter-progress>" << std::endl;
  }

private:
  std::string m_Name;
};

class JsonSink : public PercentSink
{
public:
  void
  Start(const std::string & name, const std::string & comment) override
  {
    m_Stopwatch.Start();
    std::cerr << nlohmann::ordered_json{ { "start", name }, { "comment", comment } }.dump() << std::endl;
  }

  void
  Finish(double seconds) override
  {
    this->WriteLine(1.0);
    std::cerr << nlohmann::ordered_json{ { "end", seconds } }.dump() << std::endl;
  }

  void
  Note(const std::string & text) override
  {
    std::cerr << nlohmann::ordered_json{ { "note", text } }.dump() << std::endl;
  }

  void
  Warn(const std::string & code, const std::string & message) override
  {
    std::cerr << nlohmann::ordered_json{ { "warning", code }, { "message", message } }.dump() << std::endl;
  }

protected:
  void
  WriteLine(double fraction) override
  {
    std::cerr << nlohmann::ordered_json{ { "progress", fraction }, { "seconds", m_Stopwatch.GetSeconds() } }.dump()
              << std::endl;
  }

private:
  Stopwatch m_Stopwatch;
};

} // namespace

void
ProgressSink::Start(const std::string &, const std::string &)
{}

void
ProgressSink::Report(double)
{}

void
ProgressSink::Finish(double)
{}

void
ProgressSink::Heartbeat()
{}

void
ProgressSink::Note(const std::string &)
{}

void
ProgressSink::Warn(const std::string &, const std::string & message)
{
  this->Note("warning: " + message);
}

void
ProgressSink::Record(const LogRecord &)
{}

bool
ProgressSink::IsStopRequested() const
{
  return GetStopSignal() != 0;
}

void
ThrowIfStopRequested(const ProgressSink & sink)
{
  if (sink.IsStopRequested())
  {
    throw StoppedBySignal(GetStopSignal());
  }
}

std::unique_ptr<ProgressSink>
MakeProgressSink(ProgressStyle style)
{
  switch (style)
  {
    case ProgressStyle::Auto:
      return MakeProgressSink(CanDrawOverLines() ? ProgressStyle::Bar : ProgressStyle::Plain);
    case ProgressStyle::Bar:
      return std::make_unique<BarSink>();
    case ProgressStyle::Plain:
      return std::make_unique<PlainSink>();
    case ProgressStyle::Slicer:
      return std::make_unique<SlicerSink>();
    case ProgressStyle::JsonLines:
      return std::make_unique<JsonSink>();
    case ProgressStyle::None:
      return std::make_unique<TextSink>();
    case ProgressStyle::Quiet:
      break;
  }
  return std::make_unique<ProgressSink>();
}

} // end namespace medialvoxel
