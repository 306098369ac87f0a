// Loops over threads. The only file that names OpenMP.
//
// Results never depend on the number of threads: for_each runs independent iterations, and sum adds fixed
// blocks in index order. Functors are taken by value and must not own containers, so that another machine's
// back end can take the same ones.
#pragma once
#include <omp.h>
#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <vector>

namespace geist {

/// Number of threads that loops use.
inline int threads() { return omp_get_max_threads(); }

/// Processors that this process was allowed to run on when it first asked.
inline const std::vector<int>& allowed_processors() {
  static const std::vector<int> processors = [] {
    cpu_set_t set;
    CPU_ZERO(&set);
    sched_getaffinity(0, sizeof set, &set);
    std::vector<int> list;
    for (int i = 0; i < CPU_SETSIZE; ++i)
      if (CPU_ISSET(i, &set)) list.push_back(i);
    return list;
  }();
  return processors;
}

/// Use n threads (n ≤ 0: one per allowed processor), each bound to one processor, beginning with the one we
/// run on. A single thread, or more threads than processors, may run on any; who sets OMP_PROC_BIND has
/// decided already.
inline void set_threads(int n) {
  const std::vector<int>& processors = allowed_processors();
  const int available = static_cast<int>(processors.size());
  omp_set_num_threads(n > 0 ? n : available);
  omp_set_dynamic(0);
  if (std::getenv("OMP_PROC_BIND")) return;
  const bool bind = threads() > 1 && threads() <= available;
  const auto here = std::find(processors.begin(), processors.end(), sched_getcpu()) - processors.begin();
#pragma omp parallel
  {
    cpu_set_t set;
    CPU_ZERO(&set);
    for (int i = 0; i < (bind ? 1 : available); ++i)
      CPU_SET(processors[static_cast<std::size_t>(here + omp_get_thread_num() + i) % processors.size()],
              &set);
    pthread_setaffinity_np(pthread_self(), sizeof set, &set);
  }
}

/// Let the calling thread run on any allowed processor, whatever the thread that made it is bound to.
inline void run_anywhere() {
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int processor : allowed_processors()) CPU_SET(processor, &set);
  pthread_setaffinity_np(pthread_self(), sizeof set, &set);
}

/// f(i) for i in [0, n), in contiguous shares. Fewer than `grain` iterations are not worth waking the
/// threads.
template <class F>
void for_each(std::size_t n, F f, std::size_t grain = 1) {
#pragma omp parallel for schedule(static) firstprivate(f) if (n > grain)
  for (std::size_t i = 0; i < n; ++i) f(i);
}

/// begin ≤ i < end, share `number` of all.
struct Indices {
  std::size_t begin = 0, end = 0, number = 0;
};

/// f(range) for contiguous shares of [0, n), one for each thread, the same ones whenever it is called. Fewer
/// than `grain` + 1 iterations are one share of the calling thread's. What f computes must not depend on the
/// shares.
template <class F>
void for_each_share(std::size_t n, F f, std::size_t grain = 1) {
  const std::size_t shares = n > grain ? static_cast<std::size_t>(threads()) : 1;
  for_each(shares, [=](std::size_t share) {
    f(Indices{n * share / shares, n * (share + 1) / shares, share});
  });
}

/// Σ f(i) over [0, n): blocks of fixed size are added up in index order, whatever the number of threads.
/// T needs a default constructor that makes zero, and +=.
template <class T, std::size_t block = 512, class F>
T sum(std::size_t n, F f) {
  const std::size_t blocks = (n + block - 1) / block;
  std::vector<T> part(blocks, T{});
  T* const parts = part.data();
  for_each(blocks, [=](std::size_t b) {
    T s{};
    for (std::size_t i = b * block; i < std::min(n, (b + 1) * block); ++i) s += f(i);
    parts[b] = s;
  });
  T total{};
  for (const T& p : part) total += p;
  return total;
}

}  // namespace geist
