// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ColorMap.h"

#include "itkMedialVoxelElementary.h"

#include <algorithm>
#include <cmath>

namespace medialvoxel
{
namespace
{

constexpr unsigned int NumberOfColors = 256;

/** One of the three nonlinear steps from CIELAB to XYZ. */
double
InverseLab(double value)
{
  constexpr double limit = 6.0 / 29.0;
  return value > limit ? value * value * value : 3.0 * limit * limit * (value - 4.0 / 29.0);
}

double
EncodeGamma(double linear)
{
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * itk::MedialVoxelElementary::Power(linear, 1.0 / 2.4) - 0.055;
}

/** CIELAB with the white of D65 as linear red, green and blue of sRGB; sRGB has no color outside of 0 to 1. */
std::array<double, 3>
LabToLinear(double lightness, double a, double b)
{
  const double f = (lightness + 16.0) / 116.0;
  const double x = 0.95047 * InverseLab(f + a / 500.0);
  const double y = InverseLab(f);
  const double z = 1.08883 * InverseLab(f - b / 200.0);
  return { 3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
           -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
           0.0556434 * x - 0.2040259 * y + 1.0572252 * z };
}

/** Lightness grows evenly and the hue turns evenly; the chroma is as high as the screen allows, up to a limit. */
Color
MakeMapColor(double share)
{
  constexpr double degree = 3.14159265358979323846 / 180.0;
  const double     lightness = 28.0 + 64.0 * share;
  const double     hue = (305.0 - 205.0 * share) * degree;
  const double     a = itk::MedialVoxelElementary::Cosine(hue);
  const double     b = itk::MedialVoxelElementary::Sine(hue);
  constexpr double mostChroma = 62.0;
  for (double chroma = mostChroma;; chroma -= 0.5)
  {
    const auto linear = LabToLinear(lightness, chroma * a, chroma * b);
    if (chroma <= 0.0 || std::all_of(linear.begin(), linear.end(), [](double c) { return c >= 0.0 && c <= 1.0; }))
    {
      Color color{};
      std::transform(linear.begin(), linear.end(), color.begin(), [](double component) {
        return static_cast<std::uint8_t>(std::lround(255.0 * EncodeGamma(std::clamp(component, 0.0, 1.0))));
      });
      return color;
    }
  }
}

std::array<Color, NumberOfColors>
MakeMap()
{
  std::array<Color, NumberOfColors> map{};
  for (unsigned int i = 0; i < NumberOfColors; ++i)
  {
    map[i] = MakeMapColor(i / (NumberOfColors - 1.0));
  }
  return map;
}

} // namespace

Color
GetMapColor(double share)
{
  static const std::array<Color, NumberOfColors> map = MakeMap();
  return map[static_cast<std::size_t>(std::lround(std::clamp(share, 0.0, 1.0) * (NumberOfColors - 1)))];
}

} // end namespace medialvoxel
