// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSheetProperties_h
#define itkMedialVoxelSheetProperties_h

#include "itkMedialVoxelEnums.h"
#include "itkMedialVoxelGridLimits.h"
#include "itkMedialVoxelParameters.h"
#include "itkMedialVoxelScanSurvey.h"

#include "itkProcessObject.h"

#include <cmath>
#include <optional>
#include <ostream>
#include <string>

namespace itk
{

/** \class MedialVoxelSheetProperties
 * \brief Properties of the filters that find medial sheets: which walls are sheets, and how their thickness is
 * measured.
 *
 * \par Automatic thickness
 * With ThicknessMode Automatic each cell p has a threshold of its own,
 * epsilon(p) = max(pi MinimumThickness / 2, 3 min(LT(p), MaximumThickness / 2)), where LT(p) is the radius of the
 * largest inscribed ball that covers p. MedialVoxelLocalThreshold defines it. Walls from MinimumThickness to
 * MaximumThickness then become one sheet each, without branches. A larger MinimumThickness or MaximumThickness never
 * adds medial cells.
 *
 * \par Smoothing
 * With the Smoothing On, the values of a scan are smoothed, and of everything else the mask: MedialVoxelSmoothingLevel
 * tells them apart. Walls from 2 voxels on and edges stay in place; MedialVoxelSmoothingNumbers has the definition.
 * Automatic smooths when the object is rough.
 *
 * \par Pores and dust
 * With MaximumPoreSize K, each connected component of the background of at most K voxels becomes object first. Then
 * each component of the object of at most K voxels becomes background. Everything else refers to this object. Voxels
 * are connected when they differ by at most 1 along each axis. A component that touches a face of the image stays,
 * because it may continue outside. NaN counts as background here too.
 *
 * \tparam TSuperclass  has MedialVoxelObjectProperties
 * \ingroup MedialVoxel
 */
template <typename TSuperclass>
class ITK_TEMPLATE_EXPORT MedialVoxelSheetProperties : public TSuperclass
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(MedialVoxelSheetProperties);

  using Self = MedialVoxelSheetProperties;
  using Superclass = TSuperclass;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  using ThicknessModeEnum = MedialVoxelEnums::ThicknessMode;
  using SmoothingEnum = MedialVoxelEnums::Smoothing;
  using PseudoGeodesicBoundEnum = MedialVoxelEnums::PseudoGeodesicBound;

  /** Source of the threshold on the geodesic distance. Fixed (default): Thickness, for all cells. Automatic: the wall
   * around each cell. */
  itkMedialVoxelSetEnumMacro(ThicknessMode, ThicknessModeEnum);
  itkGetEnumMacro(ThicknessMode, ThicknessModeEnum);

  /** Thickness tau of the walls that become sheets when ThicknessMode is Fixed; it sets epsilon = pi tau / 2.
   *
   * In physical units when UseImageSpacing is on, otherwise in voxels. Positive and finite; default 3. If the largest
   * spacing is more than 4 times the smallest, the thickness counts as at least the largest spacing. A larger value
   * removes branches and shrinks the sheet at its rims. */
  itkSetMacro(Thickness, double);
  itkGetConstMacro(Thickness, double);

  /** Thinner walls count as this thickness when ThicknessMode is Automatic. A smaller value keeps more of thin walls in
   * noise, and more of their branches.
   *
   * In the units of Thickness, positive and finite, or 0 (default) for 3 voxels, by the smallest spacing of the axes
   * longer than 1. */
  itkSetMacro(MinimumThickness, double);
  itkGetConstMacro(MinimumThickness, double);

  /** Walls of up to this thickness become one sheet when ThicknessMode is Automatic. Thicker ones also show branches
   * towards their edges. Time and memory grow with it.
   *
   * In the units of Thickness, finite and not smaller than MinimumThickness, or 0 (default) for 16 voxels, by the
   * smallest spacing of the axes longer than 1. The default rises by itself, up to 32 voxels, where a quarter of
   * the walls or more are thicker; a coarse look at the object finds that. Objects of label maps keep 16 voxels. */
  itkSetMacro(MaximumThickness, double);
  itkGetConstMacro(MaximumThickness, double);

  /** Cavities and grains of up to this many voxels count as noise and change sides.
   *
   * From 0, which keeps all, to 1000000. Until a value is set, it is 0 when ThicknessMode is Fixed and 32 when it is
   * Automatic. The window on the input grows by this many voxels on each side. */
  virtual void
  SetMaximumPoreSize(SizeValueType numberOfVoxels)
  {
    this->Change(m_MaximumPoreSize, std::optional<SizeValueType>(numberOfVoxels));
  }

  /** The value that was set, otherwise the default of the ThicknessMode. */
  virtual SizeValueType
  GetMaximumPoreSize() const
  {
    return m_MaximumPoreSize.value_or(
      static_cast<SizeValueType>(MedialVoxelParameters::GetDefaultMaximumPoreSize(m_ThicknessMode)));
  }

  /** Return to the default. */
  virtual void
  UnsetMaximumPoreSize()
  {
    this->Change(m_MaximumPoreSize, std::optional<SizeValueType>());
  }

  /** Smooth noise of the object away, before pores and dust are looked for. Until a value is set it is Automatic when
   * ThicknessMode is Automatic, and Off when it is Fixed. Automatic reads all of the input once more. SubvoxelThickness
   * measures the values that are not smoothed. */
  virtual void
  SetSmoothing(SmoothingEnum smoothing)
  {
    itkMedialVoxelCheckEnumMacro(Smoothing, smoothing);
    this->Change(m_Smoothing, std::optional<SmoothingEnum>(smoothing));
  }
  virtual SmoothingEnum
  GetSmoothing() const
  {
    return m_Smoothing.value_or(m_ThicknessMode == ThicknessModeEnum::Automatic ? SmoothingEnum::Automatic
                                                                                : SmoothingEnum::Off);
  }
  virtual void
  UnsetSmoothing()
  {
    this->Change(m_Smoothing, std::optional<SmoothingEnum>());
  }

  /** Bound that decides cells without a search. Default FreeSpace. */
  itkMedialVoxelSetEnumMacro(PseudoGeodesicBound, PseudoGeodesicBoundEnum);
  itkGetEnumMacro(PseudoGeodesicBound, PseudoGeodesicBoundEnum);

  /** Measure walls on the values of the image; one of the thresholds must be set. Default off. Where the image has
   * walls of 5 voxels, blurred walls are fitted to the values, which reads samples of the input once more; otherwise,
   * and with both thresholds, walls reach to where values cross the thresholds. A mask or label map is measured on the
   * object. The window keeps 4 bytes a voxel more, in single precision. See MedialVoxelGrayThickness. */
  itkSetMacro(SubvoxelThickness, bool);
  itkGetConstMacro(SubvoxelThickness, bool);
  itkBooleanMacro(SubvoxelThickness);

  /** Values of background and material for these fits, finite and not equal; by default the scan decides. */
  virtual void
  SetScanLevels(double background, double material)
  {
    m_ScanLevels = MedialVoxelScanLevels{ background, material };
    this->Modified();
  }
  virtual void
  UnsetScanLevels()
  {
    m_ScanLevels.reset();
    this->Modified();
  }

protected:
  MedialVoxelSheetProperties() = default;
  ~MedialVoxelSheetProperties() override = default;

  const std::optional<MedialVoxelScanLevels> &
  GetScanLevels() const
  {
    return m_ScanLevels;
  }

  /** The maximum thickness that is raised where walls need it; none where the user set one, or a fixed thickness. */
  std::optional<double>
  GetDefaultMaximumThickness(const MedialVoxelGrid & grid) const
  {
    if (m_ThicknessMode == ThicknessModeEnum::Fixed || m_MaximumThickness > 0.0)
    {
      return std::nullopt;
    }
    return MedialVoxelParameters::LimitsOfWalls(grid, m_MinimumThickness, 0.0).maximum;
  }

  /** Parameters of the classification of an image.
   * \param neededMaximum that walls of the image need, instead of the default */
  MedialVoxelParameters
  GetParameters(const MedialVoxelGrid & grid, const std::optional<double> & neededMaximum = {}) const
  {
    const auto limits = MedialVoxelParameters::LimitsOfWalls(grid, m_MinimumThickness, m_MaximumThickness);
    if (m_ThicknessMode == ThicknessModeEnum::Automatic && limits.minimum > limits.maximum)
    {
      itkExceptionMacro("MinimumThickness is " << limits.minimum << "; it must not be larger than MaximumThickness, "
                                               << limits.maximum << '.');
    }
    MedialVoxelParameters::Settings settings;
    settings.mode = m_ThicknessMode;
    settings.thickness = m_Thickness;
    settings.minimumThickness = m_MinimumThickness;
    settings.maximumThickness = neededMaximum.value_or(m_MaximumThickness);
    settings.maximumPoreSize = this->GetMaximumPoreSize();
    settings.bound = m_PseudoGeodesicBound;
    return MedialVoxelParameters::ForSettings(grid, settings);
  }

  /** Have the properties of another filter. */
  template <typename TOther>
  void
  CopySheetProperties(const MedialVoxelSheetProperties<TOther> & other)
  {
    m_ThicknessMode = other.m_ThicknessMode;
    m_Thickness = other.m_Thickness;
    m_MinimumThickness = other.m_MinimumThickness;
    m_MaximumThickness = other.m_MaximumThickness;
    m_MaximumPoreSize = other.m_MaximumPoreSize;
    m_Smoothing = other.m_Smoothing;
    m_PseudoGeodesicBound = other.m_PseudoGeodesicBound;
    m_SubvoxelThickness = other.m_SubvoxelThickness;
    m_ScanLevels = other.m_ScanLevels;
    this->CopyObjectProperties(other);
  }

  void
  VerifyPreconditions() const override
  {
    Superclass::VerifyPreconditions();
    if (!(m_Thickness > 0.0) || !std::isfinite(m_Thickness))
    {
      itkExceptionMacro("Thickness is " << m_Thickness << "; it must be positive and finite.");
    }
    constexpr double largest = MedialVoxelGridLimits::LargestLength;
    if (!(m_MinimumThickness >= 0.0 && m_MinimumThickness <= largest))
    {
      itkExceptionMacro("MinimumThickness is " << m_MinimumThickness << "; it must be from 0 to " << largest << '.');
    }
    if (!(m_MaximumThickness >= 0.0 && m_MaximumThickness <= largest))
    {
      itkExceptionMacro("MaximumThickness is " << m_MaximumThickness << "; it must be from 0 to " << largest << '.');
    }
    if (this->GetMaximumPoreSize() > MedialVoxelParameters::LargestMaximumPoreSize)
    {
      itkExceptionMacro("MaximumPoreSize is " << this->GetMaximumPoreSize() << "; it must not exceed "
                                              << MedialVoxelParameters::LargestMaximumPoreSize << '.');
    }
    if (m_SubvoxelThickness && !this->GetUseThresholds())
    {
      itkExceptionMacro("SubvoxelThickness is on; LowerThreshold or UpperThreshold must be set for it.");
    }
    const std::string problem =
      m_ScanLevels ? m_ScanLevels->FindProblem(this->GetLowerThreshold(), this->GetUpperThreshold()) : "";
    if (!problem.empty())
    {
      itkExceptionMacro("ScanLevels: " << problem << '.');
    }
  }

  void
  PrintSelf(std::ostream & os, Indent indent) const override
  {
    Superclass::PrintSelf(os, indent);
    os << indent << "ThicknessMode: " << m_ThicknessMode << std::endl;
    os << indent << "Thickness: " << m_Thickness << std::endl;
    os << indent << "MinimumThickness: " << m_MinimumThickness << std::endl;
    os << indent << "MaximumThickness: " << m_MaximumThickness << std::endl;
    os << indent << "MaximumPoreSize: " << this->GetMaximumPoreSize() << std::endl;
    os << indent << "Smoothing: " << this->GetSmoothing() << std::endl;
    os << indent << "PseudoGeodesicBound: " << m_PseudoGeodesicBound << std::endl;
    os << indent << "SubvoxelThickness: " << (m_SubvoxelThickness ? "On" : "Off") << std::endl;
    if (m_ScanLevels)
    {
      os << indent << "ScanLevels: " << m_ScanLevels->background << ' ' << m_ScanLevels->material << std::endl;
    }
  }

private:
  template <typename>
  friend class MedialVoxelSheetProperties;

  template <typename TValue>
  void
  Change(TValue & property, const TValue & value)
  {
    if (property != value)
    {
      property = value;
      this->Modified();
    }
  }

  ThicknessModeEnum                    m_ThicknessMode{ ThicknessModeEnum::Fixed };
  double                               m_Thickness{ 3.0 };
  double                               m_MinimumThickness{ 0.0 };
  double                               m_MaximumThickness{ 0.0 };
  std::optional<SizeValueType>         m_MaximumPoreSize;
  std::optional<SmoothingEnum>         m_Smoothing;
  PseudoGeodesicBoundEnum              m_PseudoGeodesicBound{ PseudoGeodesicBoundEnum::FreeSpace };
  bool                                 m_SubvoxelThickness{ false };
  std::optional<MedialVoxelScanLevels> m_ScanLevels;
};

} // end namespace itk

#endif
