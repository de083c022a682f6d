// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelBinding_h
#define medialvoxelBinding_h

#include <atomic>
#include <cstdint>

/** The interface that medialvoxel/_native.py calls through ctypes: plain C, so that it serves every Python. The structs
 * stand there a second time, field by field. */

#ifdef _WIN32
#  define MEDIALVOXEL_BINDING extern "C" __declspec(dllexport)
#else
#  define MEDIALVOXEL_BINDING extern "C" __attribute__((visibility("default")))
#endif

/** Voxels in memory without gaps, x fastest, in the byte order of the machine. The sizes beyond the dimension are 1.
 */
struct MedialVoxelArray
{
  const void * values;
  const char * type; ///< a name of PixelTypes
  std::int64_t dimension;
  std::int64_t size[3];
  double       spacing[3];
};

/** Shared by the calling thread and the one that watches it. */
struct MedialVoxelControl
{
  std::atomic<double>       done; ///< share of the work, from 0 to 1
  std::atomic<std::int32_t> stop; ///< not 0: give up as soon as possible
};

/** Targets of results, a value or a vector (z, y, x) for each voxel; null: not wanted. */
struct MedialVoxelOutputs
{
  std::uint8_t *  labels;
  float *         thickness;
  float *         uncertainty;
  float *         importance;
  float *         vectors;
  float *         distance;
  void *          objects; ///< of the type of the array
  std::uint32_t * walls;
};

/** How a call ended. */
enum MedialVoxelStatus : std::int32_t
{
  MedialVoxelDone,
  MedialVoxelWrongValue,
  MedialVoxelOutOfMemory,
  MedialVoxelStopped,
  MedialVoxelFailed
};

/** The surface; arrays belong to the result. */
struct MedialVoxelMesh
{
  const double *       points; ///< z, y, x
  const float *        thickness;
  const std::int64_t * faces;
  std::int64_t         numberOfPoints;
  std::int64_t         numberOfFaces;
  std::int64_t         cornersPerFace;
};

struct MedialVoxelResult;

/** \return memory for medialvoxel_release(); null when there is none
 * \param arguments of the program, from the command on, in UTF-8; names of outputs only say what is wanted */
MEDIALVOXEL_BINDING MedialVoxelResult *
medialvoxel_run(const MedialVoxelArray *   array,
                const char * const *       arguments,
                std::int32_t               numberOfArguments,
                const MedialVoxelOutputs * outputs,
                MedialVoxelControl *       control);

/** A MedialVoxelStatus. */
MEDIALVOXEL_BINDING std::int32_t
                    medialvoxel_status(const MedialVoxelResult * result);

/** What was wrong, or numbers of the run as JSON. */
MEDIALVOXEL_BINDING const char *
medialvoxel_text(const MedialVoxelResult * result);

MEDIALVOXEL_BINDING void
medialvoxel_mesh(const MedialVoxelResult * result, MedialVoxelMesh * mesh);

MEDIALVOXEL_BINDING void
medialvoxel_release(MedialVoxelResult * result);

MEDIALVOXEL_BINDING const char *
medialvoxel_version();

/** Bytes of array, control, outputs and mesh, one after the other: both sides must agree. */
MEDIALVOXEL_BINDING std::int64_t
                    medialvoxel_layout();

#endif
