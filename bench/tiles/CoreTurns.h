// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef CoreTurns_h
#define CoreTurns_h

#include <climits>
#include <cstdint>
#include <ctime>
#include <dlfcn.h>
#include <pthread.h>
#include <semaphore.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <vector>

// Threads that take turns, each with a clock of its own; one that has the turn has all of this to itself.

namespace cores
{

using Time = std::int64_t; // nanoseconds

constexpr Time Never = INT64_MAX;
enum class State : std::uint8_t
{
  Ready,
  Waiting,
  Ended
};

struct Interval
{
  Time begin;
  Time end;
};

struct Thread
{
  int                   number{ 0 };
  State                 state{ State::Ready };
  Time                  clock{ 0 };
  Time                  counted{ 0 };   // processor time of the thread that the clock has
  Time                  ofSamples{ 0 }; // processor time since then that is not work
  const volatile void * waitsFor{ nullptr };
  Time                  deadline{ Never }; // of waiting
  bool                  isLate{ false };   // the deadline came first
  sem_t                 turn{};
  timer_t               timer{};
  pthread_t             handle{};
  void * (*start)(void *){ nullptr };
  void *                argument{ nullptr };
  std::vector<Interval> intervals; // in which it ran
};

template <typename TFunction>
TFunction *
FindReal(TFunction * const, const char * const name)
{
  return reinterpret_cast<TFunction *>(dlsym(RTLD_NEXT, name));
}

#define REAL(name)                                      \
  inline decltype(&name) Real_##name()                  \
  {                                                     \
    static decltype(&name) real = nullptr;              \
    return real ? real : real = FindReal(&name, #name); \
  }
REAL(pthread_create)
REAL(pthread_join)
REAL(pthread_mutex_lock)
REAL(pthread_mutex_trylock)
REAL(pthread_mutex_unlock)
REAL(pthread_once)
REAL(clock_gettime)
REAL(nanosleep)
REAL(syscall)
#undef REAL

/** Of this thread; null before and after its turns. */
extern thread_local Thread * self __attribute__((tls_model("initial-exec")));

/** In the order in which they began; kept until the process is gone. */
std::vector<Thread *> &
GetThreads();

Time
ToTime(const timespec & time);
timespec
ToTimespec(Time time);

/** What the time of day was when all clocks were zero, or a steady clock. */
Time
GetStart(clockid_t clock);

/** What the clock of this thread would be now. */
Time
GetClock();

/** Adds the processor time to the clock of this thread. */
void
Count();

/** Before anything that others could notice: those whose clocks are earlier come first. */
void
LetOthersCatchUp();

/** \return whether the deadline came first */
bool
WaitFor(const volatile void * what, Time deadline = Never);

/** Wakes threads, longest waiting first. \return how many */
int
Wake(const volatile void * what, int most);

Thread *
AddThread(Time clock);

/** What a new thread runs: its function, in its turns. */
void *
Start(void * argument);

} // namespace cores

#endif
