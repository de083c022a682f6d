// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkStreamingNrrdImageIOFactory.h"

#include "itkStreamingNrrdImageIO.h"
#include "itkVersion.h"

namespace itk
{

StreamingNrrdImageIOFactory::StreamingNrrdImageIOFactory()
{
  this->RegisterOverride("itkImageIOBase",
                         "itkStreamingNrrdImageIO",
                         "NRRD files of raw encoding, any region at a time",
                         true,
                         CreateObjectFunction<StreamingNrrdImageIO>::New());
}

const char *
StreamingNrrdImageIOFactory::GetITKSourceVersion() const
{
  return ITK_SOURCE_VERSION;
}

const char *
StreamingNrrdImageIOFactory::GetDescription() const
{
  return "Reads and writes NRRD files of raw encoding piece by piece";
}

void
StreamingNrrdImageIOFactory::RegisterOneFactory()
{
  for (ObjectFactoryBase * const factory : ObjectFactoryBase::GetRegisteredFactories())
  {
    if (dynamic_cast<Self *>(factory) != nullptr)
    {
      return;
    }
  }
  ObjectFactoryBase::RegisterFactory(Self::New(), ObjectFactoryEnums::InsertionPosition::INSERT_AT_FRONT);
}

} // end namespace itk
