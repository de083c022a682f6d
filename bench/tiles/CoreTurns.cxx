// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "CoreTurns.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <execinfo.h>
#include <utility>

namespace cores
{

constexpr Time PeriodOfSamples = 1'000'000;
constexpr int  SignalOfSamples = 40;
constexpr int  MostFrames = 40;
constexpr int  MostSamples = 1 << 16;

struct Sample
{
  int    thread;
  int    frames;
  Time   clock;
  void * addresses[MostFrames];
};

thread_local Thread * self __attribute__((tls_model("initial-exec"))) = nullptr;
pthread_key_t         endOfThread;
timespec              startOfDay{};
timespec              startOfClock{};
Sample                samples[MostSamples];
std::atomic<int>      numberOfSamples{ 0 };

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
GetStart(const clockid_t clock)
{
  return ToTime(clock == CLOCK_REALTIME ? startOfDay : startOfClock);
}

Time
GetProcessorTime()
{
  timespec time{};
  Real_clock_gettime()(CLOCK_THREAD_CPUTIME_ID, &time);
  return ToTime(time);
}

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

void
LetOthersCatchUp()
{
  Count();
  if (GetNext(*FindNext()) < self->clock)
  {
    GiveTurn();
  }
}

bool
WaitFor(const volatile void * const what, const Time deadline)
{
  Count();
  self->state = State::Waiting;
  self->waitsFor = what;
  self->deadline = deadline < self->clock ? self->clock : deadline;
  self->isLate = false;
  GiveTurn();
  return self->isLate;
}

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

} // namespace cores
