// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelObjectProperties_h
#define itkMedialVoxelObjectProperties_h

#include "itkMedialVoxelInput.h"

#include "itkMath.h"
#include "itkNumericTraits.h"
#include "itkProcessObject.h"

#include <limits>
#include <ostream>

namespace itk
{

/** \class MedialVoxelObjectProperties
 * \brief Properties of all filters of the MedialVoxel module: object, units and memory.
 *
 * \par Object
 * Until a threshold is set, voxels that differ from BackgroundValue are object. Setting LowerThreshold or
 * UpperThreshold switches to LowerThreshold <= value <= UpperThreshold. Thresholds are compared as real numbers: 72.5
 * on an integer image means at least 73. A threshold given as an integer is exact for all 64 bits; the getters return
 * the nearest double. NaN is never object. The outside of the image is unknown: the end of the image is no boundary.
 *
 * \tparam TSuperclass  base class of ITK
 * \ingroup MedialVoxel
 */
template <typename TSuperclass>
class ITK_TEMPLATE_EXPORT MedialVoxelObjectProperties : public TSuperclass
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(MedialVoxelObjectProperties);

  using Self = MedialVoxelObjectProperties;
  using Superclass = TSuperclass;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  using InputPixelType = typename TSuperclass::InputImageType::PixelType;

  /** Value of the background as long as no threshold is set. Default 0. */
  itkSetMacro(BackgroundValue, InputPixelType);
  itkGetConstMacro(BackgroundValue, InputPixelType);

  /** Smallest value of an object voxel. Default minus infinity; not NaN, not above UpperThreshold. */
#ifdef ITK_WRAPPING_PARSER
  virtual void
  SetLowerThreshold(double threshold);
#else
  virtual void
  SetLowerThreshold(const MedialVoxelExactNumber & threshold)
  {
    this->SetThreshold(m_LowerThreshold, threshold);
  }
#endif
  double
  GetLowerThreshold() const
  {
    return m_LowerThreshold.GetNearestDouble();
  }

  /** Largest value of an object voxel. Default infinity; not NaN, not below LowerThreshold. */
#ifdef ITK_WRAPPING_PARSER
  virtual void
  SetUpperThreshold(double threshold);
#else
  virtual void
  SetUpperThreshold(const MedialVoxelExactNumber & threshold)
  {
    this->SetThreshold(m_UpperThreshold, threshold);
  }
#endif
  double
  GetUpperThreshold() const
  {
    return m_UpperThreshold.GetNearestDouble();
  }

  /** The object consists of the voxels with exactly this value, up to 64 bits, as in a label map. Setting it replaces
   * thresholds; setting a threshold replaces it. */
  virtual void
  SetObjectValue(InputPixelType value)
  {
    if (!m_UseObjectValue || !Math::ExactlyEquals(m_ObjectValue, value))
    {
      this->UnsetThresholds();
      m_UseObjectValue = true;
      m_ObjectValue = value;
      this->Modified();
    }
  }
  itkGetConstMacro(ObjectValue, InputPixelType);

  /** True when ObjectValue defines the object. Default false. */
  itkGetConstMacro(UseObjectValue, bool);

  /** Return to BackgroundValue after a threshold or ObjectValue was set. */
  virtual void
  UnsetThresholds()
  {
    if (m_UseThresholds || m_UseObjectValue)
    {
      m_UseThresholds = false;
      m_UseObjectValue = false;
      m_LowerThreshold = -std::numeric_limits<double>::infinity();
      m_UpperThreshold = std::numeric_limits<double>::infinity();
      this->Modified();
    }
  }

  /** True once a threshold was set. */
  itkGetConstMacro(UseThresholds, bool);

  /** Measure in physical units (default, as in SignedMaurerDistanceMapImageFilter) or in voxels. */
  itkSetMacro(UseImageSpacing, bool);
  itkGetConstMacro(UseImageSpacing, bool);
  itkBooleanMacro(UseImageSpacing);

  /** Limit in bytes on the window and the memory of all threads, beside the outputs and the pulled part of the input; 0
   * (default) is without limit. Slabs and tiles become smaller to keep it; results stay the same. If walls are too
   * thick for it, the update throws MedialVoxelMemoryError. */
  itkSetMacro(WorkingMemoryLimit, SizeValueType);
  itkGetConstMacro(WorkingMemoryLimit, SizeValueType);

protected:
  MedialVoxelObjectProperties() = default;
  ~MedialVoxelObjectProperties() override = default;

  MedialVoxelObjectRule
  GetObjectRule() const
  {
    if (m_UseObjectValue)
    {
      return { {}, m_ObjectValue, m_ObjectValue };
    }
    if (m_UseThresholds)
    {
      return { {}, m_LowerThreshold, m_UpperThreshold };
    }
    MedialVoxelObjectRule rule;
    rule.background = m_BackgroundValue;
    return rule;
  }

  /** Properties alone are no filter. */
  void
  GenerateData() override = 0;

  /** Have the properties of another filter. */
  template <typename TOther>
  void
  CopyObjectProperties(const MedialVoxelObjectProperties<TOther> & other)
  {
    m_BackgroundValue = other.m_BackgroundValue;
    m_LowerThreshold = other.m_LowerThreshold;
    m_UpperThreshold = other.m_UpperThreshold;
    m_UseThresholds = other.m_UseThresholds;
    m_ObjectValue = other.m_ObjectValue;
    m_UseObjectValue = other.m_UseObjectValue;
    m_UseImageSpacing = other.m_UseImageSpacing;
    m_WorkingMemoryLimit = other.m_WorkingMemoryLimit;
    this->Modified();
  }

  void
  VerifyPreconditions() const override
  {
    Superclass::VerifyPreconditions();
    if (m_LowerThreshold.IsNotANumber() || m_UpperThreshold.IsNotANumber() ||
        m_LowerThreshold.IsAbove(m_UpperThreshold))
    {
      itkExceptionMacro("The thresholds are " << m_LowerThreshold.Format() << " and " << m_UpperThreshold.Format()
                                              << "; they must be numbers, the lower one not above the upper one.");
    }
  }

  void
  PrintSelf(std::ostream & os, Indent indent) const override
  {
    using PrintType = typename NumericTraits<InputPixelType>::PrintType;
    Superclass::PrintSelf(os, indent);
    os << indent << "BackgroundValue: " << static_cast<PrintType>(m_BackgroundValue) << std::endl;
    os << indent << "LowerThreshold: " << m_LowerThreshold.Format() << std::endl;
    os << indent << "UpperThreshold: " << m_UpperThreshold.Format() << std::endl;
    os << indent << "UseThresholds: " << (m_UseThresholds ? "On" : "Off") << std::endl;
    os << indent << "ObjectValue: " << static_cast<PrintType>(m_ObjectValue) << std::endl;
    os << indent << "UseObjectValue: " << (m_UseObjectValue ? "On" : "Off") << std::endl;
    os << indent << "UseImageSpacing: " << (m_UseImageSpacing ? "On" : "Off") << std::endl;
    os << indent << "WorkingMemoryLimit: " << m_WorkingMemoryLimit << std::endl;
  }

private:
  template <typename>
  friend class MedialVoxelObjectProperties;

  void
  SetThreshold(MedialVoxelExactNumber & target, const MedialVoxelExactNumber & threshold)
  {
    m_UseObjectValue = false;
    if (!m_UseThresholds || target != threshold)
    {
      m_UseThresholds = true;
      target = threshold;
      this->Modified();
    }
  }

  InputPixelType         m_BackgroundValue{};
  MedialVoxelExactNumber m_LowerThreshold{ -std::numeric_limits<double>::infinity() };
  MedialVoxelExactNumber m_UpperThreshold{ std::numeric_limits<double>::infinity() };
  bool                   m_UseThresholds{ false };
  InputPixelType         m_ObjectValue{};
  bool                   m_UseObjectValue{ false };
  bool                   m_UseImageSpacing{ true };
  SizeValueType          m_WorkingMemoryLimit{ 0 };
};

} // end namespace itk

#endif
