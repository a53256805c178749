// Threads for weir::WorldDef::parallel_for. In a file of its own: a program that does not ask for
// them links none.
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#if defined(__SSE2__) || defined(_M_X64)
#include <emmintrin.h>
#endif

#include "port/port.hpp"

namespace port {
namespace {

/// Tries before a thread sleeps: some ten microseconds. Loops of a step follow each other faster.
constexpr int kSpins = 4000;

void pause(int spins) {
  if (spins % 256 == 255) std::this_thread::yield();
#if defined(__SSE2__) || defined(_M_X64)
  _mm_pause();
#endif
}

/// Tasks of a round that are left of those kept for one thread: the round's number, behind the last
/// task and the next one to do, in one word, so that a task is taken from the round that was looked
/// at or not at all. Nobody waits for a worker that the machine has no processor for, unless it
/// holds a task.
class Tasks {
 public:
  Tasks() = default;
  explicit Tasks(std::uint64_t bits) : bits_(bits) {}
  Tasks(std::uint64_t round, std::int64_t first, std::int64_t end)
      : bits_(round << 32U | static_cast<std::uint64_t>(end) << 16U |
              static_cast<std::uint64_t>(first)) {}

  std::uint64_t bits() const { return bits_; }
  std::int32_t next() const { return static_cast<std::int32_t>(bits_ & 0xFFFFU); }
  std::int32_t end() const { return static_cast<std::int32_t>(bits_ >> 16U & 0xFFFFU); }
  bool empty() const { return next() >= end(); }
  Tasks without_next() const { return Tasks(bits_ + 1U); }
  Tasks without_last() const { return Tasks(bits_ - (1U << 16U)); }

 private:
  std::uint64_t bits_ = 0;
};

constexpr std::int32_t kMostTasks = 0xFFFF;  // of a round

/// What one thread is to do, where no other thread's numbers are near.
struct alignas(64) Kept {
  std::atomic<std::uint64_t> tasks{0};
};

class Crew {
 public:
  ~Crew() { resize(1); }

  void resize(int threads) {
    stop_.store(true);
    wake();
    for (std::thread& worker : workers_) worker.join();
    workers_.clear();
    stop_.store(false);
    kept_ = std::vector<Kept>(static_cast<std::size_t>(threads > 1 ? threads : 1));
    for (std::size_t k = 1; k < kept_.size(); ++k) workers_.emplace_back([this, k] { work(k); });
  }

  void run(void (*task)(void*, std::int32_t), void* context, std::int32_t count) {
    if (workers_.empty() || count > kMostTasks) {
      for (std::int32_t k = 0; k < count; ++k) task(context, k);
      return;
    }
    task_ = task;
    context_ = context;
    done_.store(0, std::memory_order_relaxed);
    ++round_;
    const auto threads = static_cast<std::int64_t>(kept_.size());
    for (std::int64_t k = threads - 1; k >= 0; --k) {
      const Tasks some(round_, count * k / threads, count * (k + 1) / threads);
      kept_[static_cast<std::size_t>(k)].tasks.store(some.bits());
    }
    if (sleepers_.load() > 0) wake();
    do_tasks(0);
    for (int spins = 0; done_.load(std::memory_order_acquire) != count; ++spins) pause(spins);
  }

 private:
  void wake() {
    const std::lock_guard<std::mutex> lock(mutex_);
    wake_.notify_all();
  }

  /// Does what there is; false if there was nothing. They are counted together: the number is every
  /// thread's.
  bool do_tasks(std::size_t thread) {
    std::int32_t count = 0;
    while (take_task(thread)) ++count;
    if (count > 0) done_.fetch_add(count, std::memory_order_release);
    return count > 0;
  }

  /// Does one; false if there is none. What a round is about does not change while it has a task
  /// that is not counted.
  ///
  /// A thread does its part of the tasks from the first one on, the same part in each round: what
  /// it did before is in its cache. Then it helps the others, from their last one down.
  bool take_task(std::size_t thread) {
    if (take(kept_[thread], &Tasks::next, &Tasks::without_next, 0)) return true;
    for (std::size_t k = 1; k < kept_.size(); ++k) {
      Kept& other = kept_[(thread + k) % kept_.size()];
      if (take(other, &Tasks::end, &Tasks::without_last, -1)) return true;
    }
    return false;
  }

  bool take(Kept& of, std::int32_t (Tasks::*at)() const, Tasks (Tasks::*rest)() const,
            std::int32_t offset) {
    std::uint64_t seen = of.tasks.load(std::memory_order_acquire);
    while (!Tasks(seen).empty()) {
      if (of.tasks.compare_exchange_weak(seen, (Tasks(seen).*rest)().bits(),
                                         std::memory_order_acq_rel)) {
        task_(context_, (Tasks(seen).*at)() + offset);
        return true;
      }
    }
    return false;
  }

  void work(std::size_t thread) {
    for (int spins = 0; !stop_.load(std::memory_order_relaxed);) {
      if (do_tasks(thread)) {
        spins = 0;
      } else if (++spins < kSpins) {
        pause(spins);
      } else {
        sleep();
        spins = 0;
      }
    }
  }

  bool any_task() const {
    for (const Kept& some : kept_) {
      if (!Tasks(some.tasks.load()).empty()) return true;
    }
    return false;
  }

  void sleep() {
    std::unique_lock<std::mutex> lock(mutex_);
    sleepers_.fetch_add(1);
    wake_.wait(lock, [&] { return stop_.load() || any_task(); });
    sleepers_.fetch_sub(1);
  }

  std::vector<std::thread> workers_;
  void (*task_)(void*, std::int32_t) = nullptr;
  void* context_ = nullptr;
  std::uint64_t round_ = 0;
  std::vector<Kept> kept_{1};
  alignas(64) std::atomic<std::int32_t> done_{0};
  std::atomic<bool> stop_{false};
  std::atomic<int> sleepers_{0};
  std::mutex mutex_;
  std::condition_variable wake_;
};

Crew crew;

}  // namespace

void set_threads(int threads) { crew.resize(threads); }

void parallel_for(void (*task)(void* context, std::int32_t k), void* context, std::int32_t count) {
  crew.run(task, context, count);
}

}  // namespace port
