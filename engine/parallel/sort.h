// Sorting by a total order. The comparison must never call two different items equal (end it with an id): then the
// result is unique and does not depend on the schedule.
#pragma once

#include <functional>

#include <tbb/parallel_sort.h>

#include "engine/parallel/work.h"

namespace intarsia {

template <class Iterator, class Less = std::less<>>
void sort_total(const Work& work, Iterator begin, Iterator end, Less less = {}) {
  tbb::parallel_sort(begin, end, less);
  work.check();
}

}  // namespace intarsia
