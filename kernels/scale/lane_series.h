// Series and types of the votes in lanes, for bodies that are compiled once per instruction set. Include from .cpp
// files only. Never pass packs by value: how they travel depends on the set.
#pragma once

#include <cstdint>

#include "engine/base/instruction_set.h"
#include "engine/base/types.h"

namespace intarsia::kernels {

typedef float Floats __attribute__((vector_size(32), may_alias));
typedef std::int32_t Ints __attribute__((vector_size(32), may_alias));

// exp(-t) on [0, 1], off by at most 5e-7 (Chebyshev interpolant).
inline constexpr float kShortDecay[] = {0.9999995544211955f,  -0.9999678512244314f,  0.49962087374818953f,
                                        -0.1650127167808808f, 0.038338922328733815f, -0.00509972762672343f};
// 2 cos(2/3 acos((1 + u) / 2)) on [-1, 1], off by at most 2e-10 (Chebyshev interpolant).
inline constexpr Real kLargestRoot[] = {1.532088886237956,       0.49481813390505863,    -0.031018377241697315,
                                        0.0049326805521785685,   -0.001008242040363347,  0.00023298978167428757,
                                        -5.7880521018819046e-05, 1.4771784981478092e-05, -3.9809366683130065e-06,
                                        1.4238507203985633e-06,  -4.054614325096654e-07};

}  // namespace intarsia::kernels
