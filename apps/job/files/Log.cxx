// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Log.h"

#include "FileNames.h"
#include "ProcessIdentity.h"
#include "Text.h"

#include <nlohmann/json.hpp>

#include <array>
#include <utility>

namespace medialvoxel
{
namespace
{

constexpr size_t TimeLength = 24; // 2026-11-22T01:02:03.456Z

/** Compares with the shape of the time that a line begins with. */
bool
BeginsWithTime(const std::string & text)
{
  const std::string shape = "0000-00-00T00:00:00.000Z";
  for (size_t i = 0; i < shape.size(); ++i)
  {
    const bool isDigit = i < text.size() && text[i] >= '0' && text[i] <= '9';
    if (i >= text.size() || (shape[i] == '0' ? !isDigit : text[i] != shape[i]))
    {
      return false;
    }
  }
  return true;
}

/** A regular file must be empty or a log; other targets, for example a terminal, take any lines. */
bool
TakesLines(const SystemFile & file)
{
  const auto status = file.GetStatus();
  if (!status || !status->isFile || status->numberOfBytes == 0)
  {
    return true;
  }
  std::string begin(TimeLength, '\0');
  return file.ReadAt(0, begin.data(), begin.size()) && BeginsWithTime(begin);
}

const char *
GetName(LogLevel level)
{
  switch (level)
  {
    case LogLevel::Error:
      return "error";
    case LogLevel::Warning:
      return "warning";
    case LogLevel::Info:
      break;
  }
  return "info";
}

/** Values with blanks, quotes or line ends become a string of JSON. */
std::string
Quote(const std::string & value)
{
  const bool isPlain = !value.empty() && value.find_first_of(" \"\\=\t\r\n") == std::string::npos;
  return isPlain ? value : nlohmann::json(value).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/** \class LogSink
 * \brief The sink of MakeLogSink(). */
class LogSink : public ProgressSink
{
public:
  LogSink(Log & log, std::unique_ptr<ProgressSink> next)
    : m_Log(log)
    , m_Next(std::move(next))
  {}

  void
  Start(const std::string & name, const std::string & comment) override
  {
    m_Log.Write({ LogLevel::Info, "start", { { "work", comment } } });
    m_Next->Start(name, comment);
  }

  void
  Report(double fraction) override
  {
    m_Next->Report(fraction);
  }

  void
  Heartbeat() override
  {
    m_Next->Heartbeat();
  }

  void
  Finish(double seconds) override
  {
    m_Log.Write({ LogLevel::Info, "end", { { "seconds", FormatFixed(seconds, 3) } } });
    m_Next->Finish(seconds);
  }

  void
  Note(const std::string & text) override
  {
    m_Log.Write({ LogLevel::Info, "note", { { "text", text } } });
    m_Next->Note(text);
  }

  void
  Warn(const std::string & code, const std::string & message) override
  {
    m_Log.Write({ LogLevel::Warning, "warning", { { "code", code }, { "message", message } } });
    m_Next->Warn(code, message);
  }

  void
  Record(const LogRecord & record) override
  {
    m_Log.Write(record);
    m_Next->Record(record);
  }

  bool
  IsStopRequested() const override
  {
    return m_Next->IsStopRequested();
  }

private:
  Log &                         m_Log;
  std::unique_ptr<ProgressSink> m_Next;
};

} // namespace

Log::Log(const std::filesystem::path & fileName)
  : m_File(fileName, FileAccess::MakeLog)
{
  if (!m_File.IsOpen())
  {
    FailWithErrno(ExitStatus::Refused, "write the log", fileName);
  }
  if (!TakesLines(m_File))
  {
    Fail(ExitStatus::Refused, fileName.string(), " is not a log; lines are added to logs and empty files only");
  }
}

void
Log::Write(const LogRecord & record)
{
  std::string line =
    GetTime() + " " + GetName(record.level) + " " + std::to_string(GetThisProcess().number) + " " + record.event;
  for (const auto & [name, value] : record.values)
  {
    line += " " + name + "=" + Quote(value);
  }
  line += "\n";
  // Whatever becomes of it, the work goes on.
  m_File.Append(line.data(), line.size());
}

std::unique_ptr<ProgressSink>
MakeLogSink(Log & log, std::unique_ptr<ProgressSink> next)
{
  return std::make_unique<LogSink>(log, std::move(next));
}

} // end namespace medialvoxel
