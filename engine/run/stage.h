// One step of the method as data: the graph decides when it runs, node.h how.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "engine/parallel/work.h"

namespace intarsia {

// function sizes the output and calls kernels in order; it is pure: the output depends on the inputs and on what the
// options hash covers. An artefact type T offers, found by argument-dependent lookup:
//   std::uint64_t hash_of(const T&);          its bits, whatever the number of threads
//   std::size_t bytes_of(const T&);           memory held
//   std::size_t items_of(const T&);           size for reports (vertices, curves, patches, ...)
//   std::vector<Warning> warnings_of(const T&);   optional: what the record should tell the user
template <class Out, class... In>
struct Stage {
  std::string name;            // in reports; several stages may share it, they are then summed
  std::uint32_t revision = 1;  // raised whenever the output changes
  std::uint64_t options_hash = 0;
  std::function<Out(const Work&, const In&...)> function;
  std::string branch = {};  // tells stages of one name apart
  double weight = 1;        // expected share of the run, for progress only
  bool is_pure = true;      // false: the output depends on more than that, and is never kept for another run
};

}  // namespace intarsia
