// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Progress.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <unistd.h>

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

/** Time since the start, and an estimate of what is left. */
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

class BarSink : public TextSink
{
public:
  ~BarSink() override
  {
    // What follows, such as a message, begins on a clean line.
    this->WipeOut();
  }

  void
  Note(const std::string & text) override
  {
    this->WipeOut();
    TextSink::Note(text);
  }

  void
  Start(const std::string & name, const std::string &) override
  {
    m_Name = name;
    m_Stopwatch.Start();
    this->Draw(0.0);
  }

  void
  Report(double fraction) override
  {
    constexpr double secondsBetweenDrawings = 0.1;
    const double     now = m_Stopwatch.GetSeconds();
    if (now - m_LastDrawing >= secondsBetweenDrawings)
    {
      m_LastDrawing = now;
      this->Draw(fraction);
    }
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

  void
  Draw(double fraction)
  {
    constexpr int width = 40;
    const int     filled = std::clamp(static_cast<int>(fraction * width), 0, width);
    std::cerr << '\r' << m_Name << " [" << std::string(filled, '#') << std::string(width - filled, '.') << "] "
              << static_cast<int>(fraction * 100) << " %, " << m_Stopwatch.FormatTimeLeft(fraction) << " left\033[K"
              << std::flush;
    m_Drawn = true;
  }

  std::string m_Name;
  Stopwatch   m_Stopwatch;
  double      m_LastDrawing{ 0.0 };
  bool        m_Drawn{ false };
};

class PlainSink : public TextSink
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
    constexpr double secondsBetweenLines = 30.0;
    const double     now = m_Stopwatch.GetSeconds();
    if (now - m_LastLine >= secondsBetweenLines)
    {
      m_LastLine = now;
      std::cerr << m_Name << ": " << static_cast<int>(fraction * 100) << " % after " << FormatDuration(now) << ", "
                << m_Stopwatch.FormatTimeLeft(fraction) << " left" << std::endl;
    }
  }

private:
  std::string m_Name;
  Stopwatch   m_Stopwatch;
  double      m_LastLine{ 0.0 };
};

/** Base of the sinks that write at most one line per percent. */
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
      this->WriteLine(percent / 100.0);
    }
  }

protected:
  virtual void
  WriteLine(double fraction) = 0;

private:
  int m_Percent{ -1 };
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
ProgressSink::Note(const std::string &)
{}

void
ProgressSink::Record(const LogRecord &)
{}

bool
ProgressSink::IsStopRequested() const
{
  return GetStopSignal() != 0;
}

std::unique_ptr<ProgressSink>
MakeProgressSink(ProgressStyle style)
{
  switch (style)
  {
    case ProgressStyle::Auto:
      return MakeProgressSink(isatty(STDERR_FILENO) ? ProgressStyle::Bar : ProgressStyle::Plain);
    case ProgressStyle::Bar:
      return std::make_unique<BarSink>();
    case ProgressStyle::Plain:
      return std::make_unique<PlainSink>();
    case ProgressStyle::Slicer:
      return std::make_unique<SlicerSink>();
    case ProgressStyle::Json:
      return std::make_unique<JsonSink>();
    case ProgressStyle::None:
      return std::make_unique<TextSink>();
    case ProgressStyle::Quiet:
      break;
  }
  return std::make_unique<ProgressSink>();
}

} // end namespace medialvoxel
