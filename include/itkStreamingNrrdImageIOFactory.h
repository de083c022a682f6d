// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkStreamingNrrdImageIOFactory_h
#define itkStreamingNrrdImageIOFactory_h

#include "MedialVoxelExport.h"

#include "itkObjectFactoryBase.h"

namespace itk
{

/** \class StreamingNrrdImageIOFactory
 * \brief Lets readers and writers stream NRRD files of raw encoding.
 *
 * After RegisterOneFactory() every reader and writer that chooses its ImageIO by the file takes StreamingNrrdImageIO
 * for the files that it handles, and ITK's own NrrdImageIO for the others.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT StreamingNrrdImageIOFactory : public ObjectFactoryBase
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(StreamingNrrdImageIOFactory);

  using Self = StreamingNrrdImageIOFactory;
  using Superclass = ObjectFactoryBase;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkFactorylessNewMacro(Self);

#ifdef itkOverrideGetNameOfClassMacro
  itkOverrideGetNameOfClassMacro(StreamingNrrdImageIOFactory);
#else
  itkTypeMacro(StreamingNrrdImageIOFactory, ObjectFactoryBase);
#endif

  const char *
  GetITKSourceVersion() const override;

  const char *
  GetDescription() const override;

  /** Registers the factory in front of all others; more calls change nothing. */
  static void
  RegisterOneFactory();

protected:
  StreamingNrrdImageIOFactory();
  ~StreamingNrrdImageIOFactory() override = default;
};

} // end namespace itk

#endif
