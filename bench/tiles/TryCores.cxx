// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// medialvoxel-try-cores: threads whose times are known, for the test of medialvoxel-cores. Prints the seconds by the
// clock of the program; each piece of work takes so much processor time.

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <future>
#include <iostream>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace
{

/** Computes for so many milliseconds of processor time. */
void
WorkFor(const double milliseconds)
{
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
  };
  for (const double end = now() + milliseconds; now() < end;)
  {
  }
}

void
RunThreads(const std::vector<std::function<void()>> & works)
{
  std::vector<std::thread> threads;
  for (const auto & work : works)
  {
    threads.emplace_back(work);
  }
  for (std::thread & thread : threads)
  {
    thread.join();
  }
}

/** Threads take lengths from a list while there are some. */
void
TakeFromList(const unsigned int threads, std::vector<double> lengths)
{
  std::mutex mutex;
  RunThreads(std::vector<std::function<void()>>(threads, [&] {
    for (;;)
    {
      double length = 0.0;
      {
        const std::lock_guard<std::mutex> lock(mutex);
        if (lengths.empty())
        {
          return;
        }
        length = lengths.front();
        lengths.erase(lengths.begin());
      }
      WorkFor(length);
    }
  }));
}

/** Work of all threads under one lock. */
void
HoldLock()
{
  std::mutex mutex;
  RunThreads(std::vector<std::function<void()>>(4, [&] {
    const std::lock_guard<std::mutex> lock(mutex);
    WorkFor(20.0);
  }));
}

/** One makes a thing every 20 ms, another one takes 10 ms for each. */
void
HandOn()
{
  std::mutex              mutex;
  std::condition_variable hasMore;
  int                     made = 0;
  RunThreads({ [&] {
                for (int i = 0; i < 5; ++i)
                {
                  WorkFor(20.0);
                  const std::lock_guard<std::mutex> lock(mutex);
                  ++made;
                  hasMore.notify_one();
                }
              },
               [&] {
                 for (int i = 0; i < 5; ++i)
                 {
                   std::unique_lock<std::mutex> lock(mutex);
                   hasMore.wait(lock, [&] { return made > i; });
                   lock.unlock();
                   WorkFor(10.0);
                 }
               } });
}

/** Nobody wakes the thread. */
void
WaitInVain()
{
  std::mutex                   mutex;
  std::condition_variable      never;
  std::unique_lock<std::mutex> lock(mutex);
  never.wait_for(lock, std::chrono::milliseconds(60));
  std::this_thread::sleep_for(std::chrono::milliseconds(40));
}

void
WaitForFuture()
{
  std::promise<int> promise;
  std::thread       other([&] {
    WorkFor(50.0);
    promise.set_value(1);
    WorkFor(10.0);
  });
  promise.get_future().get();
  WorkFor(30.0);
  other.join();
}

} // namespace

int
main(int argc, char * argv[])
{
  const std::map<std::string, std::function<void()>> cases{
    { "one thread", [] { TakeFromList(1, { 20, 20, 20, 20 }); } },
    { "equal work", [] { TakeFromList(4, std::vector<double>(8, 20.0)); } },
    { "the longest work last", [] { TakeFromList(2, { 20, 20, 20, 20, 60 }); } },
    { "more threads than work", [] { TakeFromList(16, { 20, 60 }); } },
    { "a lock", HoldLock },
    { "a queue", HandOn },
    { "waiting in vain", WaitInVain },
    { "a future", WaitForFuture },
  };
  const auto found = cases.find(argc == 2 ? argv[1] : "");
  if (found == cases.end())
  {
    std::cerr << "usage: medialvoxel-try-cores CASE\n";
    return 2;
  }
  const auto start = std::chrono::steady_clock::now();
  found->second();
  std::cout << std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() << '\n';
  return EXIT_SUCCESS;
}
