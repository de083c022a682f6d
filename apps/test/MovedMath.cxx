// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// A library to preload: the functions that C libraries round differently, each an ulp beside those of this system. On
// exit it writes their names that were called to the file that MEDIALVOXEL_CALLED_MATH names.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>

namespace
{

constexpr std::size_t MostFunctions = 256;
const char *          calledNames[MostFunctions];
std::size_t           calledFunctions = 0;

/** The definition of the C library. */
template <typename TFunction>
TFunction *
Find(const char * name)
{
  if (calledFunctions < MostFunctions)
  {
    calledNames[calledFunctions++] = name;
  }
  return reinterpret_cast<TFunction *>(dlsym(RTLD_NEXT, name));
}

template <typename TBits, typename TNumber>
TNumber
MoveBits(TNumber number)
{
  TBits bits;
  std::memcpy(&bits, &number, sizeof(bits));
  bits += (bits & 1u) != 0 ? 1 : -1; // of acos(0) and acos(-1) down: what just reached a limit falls short of it
  std::memcpy(&number, &bits, sizeof(bits));
  return number;
}

/** One of both numbers beside it. */
double
Move(double number)
{
  return number != 0.0 && number - number == 0.0 ? MoveBits<std::uint64_t>(number) : number;
}
float
Move(float number)
{
  return number != 0.0f && number - number == 0.0f ? MoveBits<std::uint32_t>(number) : number;
}

struct Report
{
  ~Report()
  {
    const char * const path = std::getenv("MEDIALVOXEL_CALLED_MATH");
    std::FILE * const  file = path == nullptr ? nullptr : std::fopen(path, "a");
    if (file != nullptr)
    {
      for (std::size_t i = 0; i < calledFunctions; ++i)
      {
        std::fprintf(file, "%s\n", calledNames[i]);
      }
      std::fclose(file);
    }
  }
} report;

} // namespace

#define MOVE(TNumber, name, parameters, arguments)                  \
  __attribute__((visibility("default"))) TNumber name parameters    \
  {                                                                 \
    static auto * const original = Find<TNumber parameters>(#name); \
    return Move(original arguments);                                \
  }
#define MOVE_ONE(name)                \
  MOVE(double, name, (double x), (x)) \
  MOVE(float, name##f, (float x), (x))
#define MOVE_TWO(name)                             \
  MOVE(double, name, (double x, double y), (x, y)) \
  MOVE(float, name##f, (float x, float y), (x, y))

extern "C"
{
  MOVE_ONE(acos)
  MOVE_ONE(acosh)
  MOVE_ONE(asin)
  MOVE_ONE(asinh)
  MOVE_ONE(atan)
  MOVE_ONE(atanh)
  MOVE_ONE(cbrt)
  MOVE_ONE(cos)
  MOVE_ONE(cosh)
  MOVE_ONE(erf)
  MOVE_ONE(erfc)
  MOVE_ONE(exp)
  MOVE_ONE(exp2)
  MOVE_ONE(exp10)
  MOVE_ONE(expm1)
  MOVE_ONE(lgamma)
  MOVE_ONE(log)
  MOVE_ONE(log2)
  MOVE_ONE(log10)
  MOVE_ONE(log1p)
  MOVE_ONE(sin)
  MOVE_ONE(sinh)
  MOVE_ONE(tan)
  MOVE_ONE(tanh)
  MOVE_ONE(tgamma)
  MOVE_TWO(atan2)
  MOVE_TWO(hypot)
  MOVE_TWO(pow)

  // What compilers make of a sine and a cosine of one angle.
  __attribute__((visibility("default"))) void
  sincos(double x, double * sine, double * cosine)
  {
    *sine = sin(x);
    *cosine = cos(x);
  }
  __attribute__((visibility("default"))) void
  sincosf(float x, float * sine, float * cosine)
  {
    *sine = sinf(x);
    *cosine = cosf(x);
  }
}
