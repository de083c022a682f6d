// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "HtmlReport.h"
#include "Text.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

namespace medialvoxel
{
namespace
{

constexpr double Width = 760.0;
constexpr double Height = 260.0;
constexpr double Left = 90.0;
constexpr double Right = 90.0;
constexpr double Top = 34.0;
constexpr double Bottom = 42.0;

/** A step of 1, 2 or 5 times a power of ten that divides the range into at most eight parts. */
double
GetTickStep(double range)
{
  const double least = range / 8.0;
  const double power = GetPowerOfTenUpTo(least);
  for (const double factor : { 1.0, 2.0, 5.0 })
  {
    if (factor * power >= least)
    {
      return factor * power;
    }
  }
  return 10.0 * power;
}

/** Coordinates to a hundredth of a pixel. */
std::string
Coordinate(double value)
{
  return FormatNumber(std::round(value * 100.0) / 100.0);
}

/** Draws into an SVG text, in lengths along the horizontal axis. */
class Chart
{
public:
  explicit Chart(const Json & histogram)
    : m_Areas(histogram["areas"].get<std::vector<double>>())
    , m_BinWidth(histogram["bin_width"])
    , m_First(0)
  {
    while (m_Areas[m_First] == 0.0)
    {
      ++m_First;
    }
    m_Least = (static_cast<double>(m_First) - 1.0) * m_BinWidth;
    m_Most = static_cast<double>(m_Areas.size()) * m_BinWidth;
  }

  void
  DrawBars()
  {
    const double highest = *std::max_element(m_Areas.begin(), m_Areas.end());
    const double width = (Width - Left - Right) * m_BinWidth / (m_Most - m_Least);
    for (std::size_t bin = m_First; bin < m_Areas.size(); ++bin)
    {
      if (m_Areas[bin] == 0.0)
      {
        continue;
      }
      const double middle = static_cast<double>(bin) * m_BinWidth;
      const double height = std::max(0.5, (Height - Top - Bottom) * m_Areas[bin] / highest);
      m_Text << "<rect class=\"bar\" x=\"" << Coordinate(this->GetX(middle) - 0.46 * width) << "\" y=\""
             << Coordinate(Height - Bottom - height) << "\" width=\"" << Coordinate(0.92 * width) << "\" height=\""
             << Coordinate(height) << "\"><title>" << FormatNumber(middle - m_BinWidth / 2) << " to "
             << FormatNumber(middle + m_BinWidth / 2) << ": area " << FormatShort(m_Areas[bin]) << "</title></rect>\n";
    }
  }

  void
  DrawAxis(const std::string & unit)
  {
    const double bottom = Height - Bottom;
    m_Text << "<line class=\"axis\" x1=\"" << Left << "\" y1=\"" << bottom << "\" x2=\"" << Width - Right << "\" y2=\""
           << bottom << "\"/>\n";
    const double step = GetTickStep(m_Most - m_Least);
    for (double tick = std::ceil(std::max(0.0, m_Least) / step); tick * step <= m_Most; tick += 1.0)
    {
      const std::string x = Coordinate(this->GetX(tick * step));
      m_Text << "<line class=\"axis\" x1=\"" << x << "\" y1=\"" << bottom << "\" x2=\"" << x << "\" y2=\"" << bottom + 5
             << "\"/><text x=\"" << x << "\" y=\"" << bottom + 18 << "\" text-anchor=\"middle\">"
             << FormatShort(tick * step) << "</text>\n";
    }
    m_Text << "<text x=\"" << Width / 2 << "\" y=\"" << Height - 6 << "\" text-anchor=\"middle\">thickness, " << unit
           << "</text>\n";
  }

  /** \param isAtLeft the name stands at the left of the line */
  void
  DrawMark(double length, const std::string & name, bool isAtLeft)
  {
    const double      position = this->GetX(length);
    const std::string x = Coordinate(position);
    const double      y = 14.0;
    m_Text << "<line class=\"" << name << "\" x1=\"" << x << "\" y1=\"" << y - 8 << "\" x2=\"" << x << "\" y2=\""
           << Height - Bottom << "\"/><text class=\"" << name << "\" x=\"" << Coordinate(position + (isAtLeft ? -5 : 5))
           << "\" y=\"" << y << "\" text-anchor=\"" << (isAtLeft ? "end" : "start") << "\">" << name << ' '
           << FormatShort(length) << "</text>\n";
  }

  std::string
  GetText() const
  {
    std::ostringstream svg;
    svg << "<svg viewBox=\"0 0 " << Width << ' ' << Height
        << "\" role=\"img\" aria-label=\"Histogram of the thickness, by area of the sheet\">\n"
        << m_Text.str() << "</svg>\n";
    return svg.str();
  }

private:
  double
  GetX(double length) const
  {
    return Left + (Width - Left - Right) * (length - m_Least) / (m_Most - m_Least);
  }

  std::vector<double> m_Areas;
  double              m_BinWidth;
  std::size_t         m_First;
  double              m_Least;
  double              m_Most;
  std::ostringstream  m_Text;
};

} // namespace

std::string
MakeHistogramSvg(const Json & thickness, const std::string & unit)
{
  Chart chart(thickness["histogram"]);
  chart.DrawBars();
  chart.DrawAxis(unit);
  const double mean = thickness["mean"];
  const double median = thickness["percentiles"]["50"];
  chart.DrawMark(mean, "mean", mean < median);
  chart.DrawMark(median, "median", mean >= median);
  return chart.GetText();
}

} // end namespace medialvoxel
