#include "tools/interrupt.hpp"

#include <atomic>
#include <chrono>
#include <csignal>

namespace vlbeam {
namespace {

using Clock = std::chrono::steady_clock;  // clock_gettime: a signal handler may call it
constexpr Clock::rep one_cause = std::chrono::duration_cast<Clock::duration>(std::chrono::milliseconds{500}).count();

std::atomic<int> received{0};
std::atomic<Clock::rep> first_interrupt{0};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<Clock::rep>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

extern "C" void on_interrupt(int signal) {
  received = signal;
  if (signal != SIGINT) return;
  // A signal may come twice for one cause: from the terminal and the shell, from timeout to the process and its group.
  const Clock::rep now = Clock::now().time_since_epoch().count();
  Clock::rep first = 0;
  if (first_interrupt.compare_exchange_strong(first, now) || now - first < one_cause) return;
  std::signal(SIGINT, SIG_DFL);
  std::raise(SIGINT);
}

}  // namespace

void install_interrupt_handler() {
  for (const int signal : {SIGINT, SIGTERM, SIGXCPU}) std::signal(signal, on_interrupt);
  if (std::signal(SIGHUP, on_interrupt) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

void ignore_file_size_signal() { std::signal(SIGXFSZ, SIG_IGN); }

int interruption() { return received; }

void ask_to_stop(int signal) { received = signal; }

}  // namespace vlbeam
