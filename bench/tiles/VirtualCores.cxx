// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// medialvoxel-cores: a library to preload that runs a program on paper with a core for each of its threads.
// One thread runs at a time, that whose clock is earliest, up to its next call that other threads could notice. Clocks
// count the processor time of their thread, and waiting for others; the program sees them as the time of day. Memory
// and caches that cores share, and disks, are left out, so that its times are bounds. At its end it writes when each
// thread ran, and what it did then, to the file that MEDIALVOXEL_CORES names; bench/measure_tiles.py reads that.

#include "CoreTurns.h"

#include <cerrno>
#include <cstdarg>
#include <linux/futex.h>

using namespace cores;

namespace
{

int
Lock(pthread_mutex_t * const mutex)
{
  int result;
  while ((result = Real_pthread_mutex_trylock()(mutex)) == EBUSY)
  {
    WaitFor(mutex);
  }
  return result;
}

/** Others that want the lock until now are to find it taken. */
int
Unlock(pthread_mutex_t * const mutex)
{
  LetOthersCatchUp();
  const int result = Real_pthread_mutex_unlock()(mutex);
  Wake(mutex, INT_MAX);
  return result;
}

Time
FromDeadline(const clockid_t clock, const timespec & deadline)
{
  return ToTime(deadline) - GetStart(clock);
}

int
Await(pthread_cond_t * const condition, pthread_mutex_t * const mutex, const Time deadline)
{
  Unlock(mutex);
  const bool isLate = WaitFor(condition, deadline);
  Lock(mutex);
  return isLate ? ETIMEDOUT : 0;
}

long
CallFutex(int * const word, const int operation, const int value, const timespec * const time)
{
  const int command = operation & FUTEX_CMD_MASK;
  LetOthersCatchUp();
  if (command == FUTEX_WAKE)
  {
    return Wake(word, value);
  }
  if (__atomic_load_n(word, __ATOMIC_SEQ_CST) != value)
  {
    errno = EAGAIN;
    return -1;
  }
  const clockid_t clock = (operation & FUTEX_CLOCK_REALTIME) != 0 ? CLOCK_REALTIME : CLOCK_MONOTONIC;
  const Time      deadline = time == nullptr         ? Never
                             : command == FUTEX_WAIT ? self->clock + ToTime(*time)
                                                     : FromDeadline(clock, *time);
  if (WaitFor(word, deadline))
  {
    errno = ETIMEDOUT;
    return -1;
  }
  return 0;
}

} // namespace

extern "C"
{
  int
  pthread_create(pthread_t * handle, const pthread_attr_t * attributes, void * (*start)(void *), void * argument)
  {
    Count();
    Thread * const thread = AddThread(self->clock);
    thread->start = start;
    thread->argument = argument;
    const int result = Real_pthread_create()(&thread->handle, attributes, Start, thread);
    *handle = thread->handle;
    return result;
  }

  int
  pthread_join(pthread_t handle, void ** result)
  {
    for (Thread * const thread : GetThreads())
    {
      while (self != nullptr && pthread_equal(thread->handle, handle) != 0 && thread->state != State::Ended)
      {
        WaitFor(thread);
      }
    }
    return Real_pthread_join()(handle, result);
  }

  int
  pthread_mutex_lock(pthread_mutex_t * mutex)
  {
    if (self == nullptr)
    {
      return Real_pthread_mutex_lock()(mutex);
    }
    LetOthersCatchUp();
    return Lock(mutex);
  }

  int
  pthread_mutex_trylock(pthread_mutex_t * mutex)
  {
    if (self != nullptr)
    {
      LetOthersCatchUp();
    }
    return Real_pthread_mutex_trylock()(mutex);
  }

  int
  pthread_mutex_unlock(pthread_mutex_t * mutex)
  {
    return self == nullptr ? Real_pthread_mutex_unlock()(mutex) : Unlock(mutex);
  }

  /** Promises are kept in it. */
  int
  pthread_once(pthread_once_t * once, void (*function)())
  {
    if (self != nullptr)
    {
      LetOthersCatchUp();
    }
    return Real_pthread_once()(once, function);
  }

  int
  pthread_cond_wait(pthread_cond_t * condition, pthread_mutex_t * mutex)
  {
    return Await(condition, mutex, Never);
  }

  int
  pthread_cond_timedwait(pthread_cond_t * condition, pthread_mutex_t * mutex, const timespec * deadline)
  {
    return Await(condition, mutex, FromDeadline(CLOCK_REALTIME, *deadline));
  }

  int
  pthread_cond_clockwait(pthread_cond_t *  condition,
                         pthread_mutex_t * mutex,
                         clockid_t         clock,
                         const timespec *  deadline)
  {
    return Await(condition, mutex, FromDeadline(clock, *deadline));
  }

  int
  pthread_cond_signal(pthread_cond_t * condition)
  {
    if (self != nullptr)
    {
      LetOthersCatchUp();
      Wake(condition, 1);
    }
    return 0;
  }

  int
  pthread_cond_broadcast(pthread_cond_t * condition)
  {
    if (self != nullptr)
    {
      LetOthersCatchUp();
      Wake(condition, INT_MAX);
    }
    return 0;
  }

  int
  clock_gettime(clockid_t clock, timespec * time)
  {
    if (self == nullptr || (clock != CLOCK_REALTIME && clock != CLOCK_MONOTONIC))
    {
      return Real_clock_gettime()(clock, time);
    }
    *time = ToTimespec(GetClock() + GetStart(clock));
    return 0;
  }

  int
  nanosleep(const timespec * time, timespec * rest)
  {
    if (self == nullptr)
    {
      return Real_nanosleep()(time, rest);
    }
    WaitFor(nullptr, GetClock() + ToTime(*time));
    return 0;
  }

  long
  syscall(long number, ...)
  {
    std::va_list list;
    va_start(list, number);
    long values[6];
    for (long & value : values)
    {
      value = va_arg(list, long);
    }
    va_end(list);
    const int operation = static_cast<int>(values[1]) & FUTEX_CMD_MASK;
    if (self != nullptr && number == SYS_futex &&
        (operation == FUTEX_WAIT || operation == FUTEX_WAIT_BITSET || operation == FUTEX_WAKE))
    {
      return CallFutex(reinterpret_cast<int *>(values[0]),
                       static_cast<int>(values[1]),
                       static_cast<int>(values[2]),
                       reinterpret_cast<const timespec *>(values[3]));
    }
    return Real_syscall()(number, values[0], values[1], values[2], values[3], values[4], values[5]);
  }
}
