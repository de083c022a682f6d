// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// medialvoxel-cores: a library to preload that runs a program on paper with a core for each of its threads.
// One thread runs at a time, that whose clock is earliest, up to its next call that other threads could notice. Clocks
// count the processor time of their thread, and waiting for others; the program sees them as the time of day. Memory and
// caches that cores share, and disks, are left out, so that its times are bounds. At its end it writes when each thread
// ran, and what it did then, to the file that MEDIALVOXEL_CORES names; bench/measure_tiles.py reads that.

#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <dlfcn.h>
#include <execinfo.h>
#include <linux/futex.h>
#include <pthread.h>
#include <semaphore.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace
{

using Time = std::int64_t; // nanoseconds

constexpr Time Never = INT64_MAX;
constexpr Time PeriodOfSamples = 1'000'000;
constexpr int  SignalOfSamples = 40;
constexpr int  MostFrames = 40;
constexpr int  MostSamples = 1 << 16;

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
  Time                  counted{ 0 };      // processor time of the thread that the clock has
  Time                  ofSamples{ 0 };    // processor time since then that is not work
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

struct Sample
{
  int    thread;
  int    frames;
  Time   clock;
  void * addresses[MostFrames];
};

template <typename TFunction>
TFunction *
FindReal(TFunction * const, const char * const name)
{
  return reinterpret_cast<TFunction *>(dlsym(RTLD_NEXT, name));
}

#define REAL(name)                                                                                                     \
  decltype(&name) Real_##name()                                                                                        \
  {                                                                                                                    \
    static decltype(&name) real = nullptr;                                                                             \
    return real ? real : real = FindReal(&name, #name);                                                                \
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

thread_local Thread * self __attribute__((tls_model("initial-exec"))) = nullptr;
pthread_key_t         endOfThread;
timespec              startOfDay{};
timespec              startOfClock{};
Sample                samples[MostSamples];
std::atomic<int>      numberOfSamples{ 0 };

/** In the order in which they began; kept until the process is gone. */
std::vector<Thread *> &
GetThreads()
{
  static auto * const threads = new std::vector<Thread *>;
  return *threads;
}

Time
ToTime(const timespec & time)
{
  return Time{ time.tv_sec } * 1'000'000'000 + time.tv_nsec;
}

timespec
ToTimespec(const Time time)
{
  return { static_cast<time_t>(time / 1'000'000'000), static_cast<long>(time % 1'000'000'000) };
}

Time
GetProcessorTime()
{
  timespec time{};
  Real_clock_gettime()(CLOCK_THREAD_CPUTIME_ID, &time);
  return ToTime(time);
}

/** What the clock of this thread would be now. */
Time
GetClock()
{
  return self->clock + (GetProcessorTime() - self->counted - self->ofSamples);
}

void
Count()
{
  const Time time = GetProcessorTime();
  self->clock += time - self->counted - std::exchange(self->ofSamples, 0);
  self->counted = time;
  self->intervals.back().end = self->clock;
}

Time
GetNext(const Thread & thread)
{
  return thread.state == State::Ready ? thread.clock : thread.state == State::Waiting ? thread.deadline : Never;
}

/** The thread whose turn it is; of several the one that began first. */
Thread *
FindNext()
{
  Thread * next = nullptr;
  Time     least = Never;
  for (Thread * const thread : GetThreads())
  {
    if (GetNext(*thread) < least)
    {
      next = thread;
      least = GetNext(*thread);
    }
  }
  return next;
}

void
WaitForTurn()
{
  while (sem_wait(&self->turn) != 0)
  {
  }
}

/** Gives the turn to the thread that has it; returns when it is this one's again, unless this one has ended. */
void
GiveTurn()
{
  Thread * const next = FindNext();
  if (next == nullptr)
  {
    if (self->state == State::Ended)
    {
      return;
    }
    std::fputs("medialvoxel-cores: all threads wait for each other\n", stderr);
    std::abort();
  }
  if (next->state == State::Waiting)
  {
    next->state = State::Ready;
    next->isLate = true;
    next->clock = next->deadline;
  }
  if (next != self)
  {
    sem_post(&next->turn);
    if (self->state == State::Ended)
    {
      return;
    }
    WaitForTurn();
  }
  self->counted = GetProcessorTime();
  self->ofSamples = 0;
  if (self->intervals.back().end < self->clock)
  {
    self->intervals.push_back({ self->clock, self->clock });
  }
}

/** Before anything that others could notice: those whose clocks are earlier come first. */
void
LetOthersCatchUp()
{
  Count();
  if (GetNext(*FindNext()) < self->clock)
  {
    GiveTurn();
  }
}

/** \return whether the deadline came first */
bool
WaitFor(const volatile void * const what, const Time deadline = Never)
{
  Count();
  self->state = State::Waiting;
  self->waitsFor = what;
  self->deadline = deadline < self->clock ? self->clock : deadline;
  self->isLate = false;
  GiveTurn();
  return self->isLate;
}

/** Wakes threads, longest waiting first. \return how many */
int
Wake(const volatile void * const what, const int most)
{
  Count();
  int number = 0;
  for (Thread * first = self; first != nullptr && number < most;)
  {
    first = nullptr;
    for (Thread * const thread : GetThreads())
    {
      const bool waits = thread->state == State::Waiting && thread->waitsFor == what;
      first = waits && (first == nullptr || thread->clock < first->clock) ? thread : first;
    }
    if (first != nullptr)
    {
      first->state = State::Ready;
      first->clock = self->clock;
      ++number;
    }
  }
  return number;
}

/** What it calls does not wait for a turn. */
void
TakeSample(int, siginfo_t *, void *)
{
  const int      error = errno;
  const Time     begin = GetProcessorTime();
  Thread * const thread = std::exchange(self, nullptr);
  const int      number = thread != nullptr ? numberOfSamples++ : MostSamples;
  if (number < MostSamples)
  {
    Sample & sample = samples[number];
    sample.thread = thread->number;
    sample.clock = thread->clock + (begin - thread->counted - thread->ofSamples);
    sample.frames = backtrace(sample.addresses, MostFrames);
    thread->ofSamples += GetProcessorTime() - begin;
  }
  self = thread;
  errno = error;
}

/** From now on this thread is sampled. */
void
StartTimer()
{
  sigevent event{};
  event.sigev_notify = SIGEV_THREAD_ID;
  event.sigev_signo = SignalOfSamples;
  event._sigev_un._tid = gettid();
  timer_create(CLOCK_THREAD_CPUTIME_ID, &event, &self->timer);
  const timespec   period = ToTimespec(PeriodOfSamples);
  const itimerspec setting{ period, period };
  timer_settime(self->timer, 0, &setting, nullptr);
}

Thread *
AddThread(const Time clock)
{
  auto * const thread = new Thread;
  thread->number = static_cast<int>(GetThreads().size());
  thread->clock = clock;
  thread->intervals.push_back({ clock, clock });
  sem_init(&thread->turn, 0, 0);
  GetThreads().push_back(thread);
  return thread;
}

/** After all that thread_local objects do. */
void
End(void *)
{
  timer_delete(self->timer);
  Wake(self, INT_MAX);
  self->state = State::Ended;
  GiveTurn();
  self = nullptr;
}

void *
Start(void * const argument)
{
  self = static_cast<Thread *>(argument);
  pthread_setspecific(endOfThread, self);
  WaitForTurn();
  self->counted = GetProcessorTime();
  StartTimer();
  return self->start(self->argument);
}

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
  return ToTime(deadline) - ToTime(clock == CLOCK_REALTIME ? startOfDay : startOfClock);
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
  const Time      deadline = time == nullptr           ? Never
                             : command == FUTEX_WAIT ? self->clock + ToTime(*time)
                                                       : FromDeadline(clock, *time);
  if (WaitFor(word, deadline))
  {
    errno = ETIMEDOUT;
    return -1;
  }
  return 0;
}

/** Intervals of all threads, samples, and where the files of their code are in memory. */
void
Write(std::FILE * const file)
{
  std::fputs("{\"threads\": [", file);
  for (const Thread * const thread : GetThreads())
  {
    std::fputs(thread->number == 0 ? "[" : "], [", file);
    for (const Interval & interval : thread->intervals)
    {
      std::fprintf(file,
                   "%s[%lld, %lld]",
                   &interval == thread->intervals.data() ? "" : ", ",
                   static_cast<long long>(interval.begin),
                   static_cast<long long>(interval.end));
    }
  }
  std::fputs("]], \"samples\": [", file);
  for (int i = 0; i < numberOfSamples && i < MostSamples; ++i)
  {
    const Sample & sample = samples[i];
    std::fprintf(file, "%s[%d, %lld", i == 0 ? "" : ", ", sample.thread, static_cast<long long>(sample.clock));
    for (int frame = 0; frame < sample.frames; ++frame)
    {
      Dl_info    info{};
      const bool isKnown = dladdr(sample.addresses[frame], &info) != 0;
      const auto offset = static_cast<char *>(sample.addresses[frame]) - static_cast<char *>(info.dli_fbase);
      std::fprintf(file, ", \"%s %tx\"", isKnown ? info.dli_fname : "", offset);
    }
    std::fputs("]", file);
  }
  std::fputs("]}\n", file);
}

__attribute__((constructor)) void
Begin()
{
  void * address = nullptr;
  backtrace(&address, 1); // loads what it needs
  Real_clock_gettime()(CLOCK_REALTIME, &startOfDay);
  Real_clock_gettime()(CLOCK_MONOTONIC, &startOfClock);
  pthread_key_create(&endOfThread, End);
  struct sigaction action{};
  action.sa_sigaction = TakeSample;
  action.sa_flags = SA_RESTART | SA_SIGINFO;
  sigaction(SignalOfSamples, &action, nullptr);
  self = AddThread(0);
  self->counted = GetProcessorTime();
  StartTimer();
}

__attribute__((destructor)) void
Finish()
{
  const char * const name = std::getenv("MEDIALVOXEL_CORES");
  if (self == nullptr || name == nullptr)
  {
    return;
  }
  Count();
  if (std::FILE * const file = std::fopen(name, "w"))
  {
    Write(file);
    std::fclose(file);
  }
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
  pthread_cond_clockwait(pthread_cond_t * condition, pthread_mutex_t * mutex, clockid_t clock, const timespec * deadline)
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
    *time = ToTimespec(GetClock() + ToTime(clock == CLOCK_REALTIME ? startOfDay : startOfClock));
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
