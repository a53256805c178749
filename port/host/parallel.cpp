// Threads for weir::WorldDef::parallel_for. In a file of its own: a program that does not ask for
// them links none.
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "port/port.hpp"

namespace port {
namespace {

/// Tries before a thread sleeps: some ten microseconds. Loops of a step follow each other faster.
constexpr int kSpins = 4000;

void pause(int spins) {
  if (spins % 64 == 63) std::this_thread::yield();
#if defined(__SSE2__)
  __builtin_ia32_pause();
#endif
}

/// Tasks that are left of a round: its number, how many tasks it has and the next one to do, in one
/// word, so that a task is taken from the round that was looked at or not at all. Nobody waits for
/// a worker that the machine has no processor for, unless it holds a task.
class Round {
 public:
  Round() = default;
  explicit Round(std::uint64_t bits) : bits_(bits) {}
  Round(std::uint64_t number, std::int32_t count)
      : bits_(number << 32U | static_cast<std::uint64_t>(count) << 16U) {}

  std::uint64_t bits() const { return bits_; }
  std::uint64_t number() const { return bits_ >> 32U; }
  std::int32_t count() const { return static_cast<std::int32_t>(bits_ >> 16U & 0xFFFFU); }
  std::int32_t next() const { return static_cast<std::int32_t>(bits_ & 0xFFFFU); }
  bool empty() const { return next() >= count(); }

 private:
  std::uint64_t bits_ = 0;
};

constexpr std::int32_t kMostTasks = 0xFFFF;  // of a round

class Crew {
 public:
  ~Crew() { resize(1); }

  void resize(int threads) {
    stop_.store(true);
    wake();
    for (std::thread& worker : workers_) worker.join();
    workers_.clear();
    stop_.store(false);
    for (int k = 1; k < threads; ++k) workers_.emplace_back([this] { work(); });
  }

  void run(void (*task)(void*, std::int32_t), void* context, std::int32_t count) {
    if (workers_.empty() || count > kMostTasks) {
      for (std::int32_t k = 0; k < count; ++k) task(context, k);
      return;
    }
    task_ = task;
    context_ = context;
    done_.store(0, std::memory_order_relaxed);
    ++number_;
    round_.store(Round(number_, count).bits());
    if (sleepers_.load() > 0) wake();
    while (take_task()) {
    }
    for (int spins = 0; done_.load(std::memory_order_acquire) != count; ++spins) pause(spins);
  }

 private:
  void wake() {
    const std::lock_guard<std::mutex> lock(mutex_);
    wake_.notify_all();
  }

  /// Does one; false if there is none. What a round is about does not change while it has a task
  /// that is not done.
  bool take_task() {
    std::uint64_t seen = round_.load(std::memory_order_acquire);
    while (!Round(seen).empty()) {
      if (round_.compare_exchange_weak(seen, seen + 1, std::memory_order_acq_rel)) {
        task_(context_, Round(seen).next());
        done_.fetch_add(1, std::memory_order_release);
        return true;
      }
    }
    return false;
  }

  void work() {
    for (int spins = 0; !stop_.load(std::memory_order_relaxed);) {
      if (take_task()) {
        spins = 0;
      } else if (++spins < kSpins) {
        pause(spins);
      } else {
        sleep();
        spins = 0;
      }
    }
  }

  void sleep() {
    std::unique_lock<std::mutex> lock(mutex_);
    sleepers_.fetch_add(1);
    wake_.wait(lock, [&] { return stop_.load() || !Round(round_.load()).empty(); });
    sleepers_.fetch_sub(1);
  }

  std::vector<std::thread> workers_;
  void (*task_)(void*, std::int32_t) = nullptr;
  void* context_ = nullptr;
  std::uint64_t number_ = 0;
  std::atomic<std::uint64_t> round_{0};
  std::atomic<std::int32_t> done_{0};
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
