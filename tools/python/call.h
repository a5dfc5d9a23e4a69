// A call of the library from Python: in a thread of its own without the interpreter's lock, while the calling thread
// hands on progress and looks for signals.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include <pybind11/pybind11.h>

#include "graph/api/intarsia.h"

namespace intarsia::tools {

// The progress function is called in the thread that called the library, as Python programs expect.
class PythonCall {
 public:
  explicit PythonCall(pybind11::object progress) : progress_(std::move(progress)) {}

  // make: RunControl -> Result. Requires: the lock is held.
  // Errors: the Python exception of a signal handler (KeyboardInterrupt) or of the progress function.
  template <class Make>
  auto operator()(int threads, const Make& make) {
    RunControl control;
    control.threads = threads;
    control.cancel = &cancel_;
    if (!progress_.is_none())
      control.progress = [this](std::string_view stage, double fraction) {
        publish(stage, fraction);
        return true;
      };
    std::optional<decltype(make(control))> result;
    {
      const pybind11::gil_scoped_release release;
      std::thread worker([&] {
        result.emplace(make(control));
        const std::lock_guard lock(mutex_);
        done_ = true;
        wake_.notify_all();
      });
      attend();
      worker.join();
    }
    if (raised_) std::rethrow_exception(std::exchange(raised_, nullptr));
    return std::move(*result);
  }

 private:
  void publish(std::string_view stage, double fraction) {
    const std::lock_guard lock(mutex_);
    stage_ = stage, fraction_ = fraction, is_news_ = true;
    wake_.notify_all();
  }

  void attend() {
    bool done = false;
    while (!done) {
      std::string stage;
      double fraction = 0;
      bool is_news = false;
      {
        std::unique_lock lock(mutex_);
        wake_.wait_for(lock, std::chrono::milliseconds(50), [this] { return done_ || is_news_; });
        done = done_, is_news = std::exchange(is_news_, false);
        stage = stage_, fraction = fraction_;
      }
      if (raised_) continue;  // it only has to end now
      const pybind11::gil_scoped_acquire acquire;
      try {
        if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
        if (!is_news) continue;
        const pybind11::object answer = progress_(stage, fraction);
        if (!answer.is_none() && !pybind11::bool_(answer)) cancel_ = true;
      } catch (...) {
        raised_ = std::current_exception(), cancel_ = true;
      }
    }
  }

  pybind11::object progress_;
  std::atomic<bool> cancel_{false};
  std::exception_ptr raised_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false, is_news_ = false;
  std::string stage_;
  double fraction_ = 0;
};

}  // namespace intarsia::tools
