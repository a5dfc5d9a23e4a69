// Which vector instructions the processor has, for loops that are compiled for several sets and chosen while running.
// Contraction is off in every unit and lanes never mix, so every set gives the same bits.
#pragma once

#include <cstdint>

namespace intarsia {

enum class InstructionSet : std::uint8_t { baseline = 0, avx2 = 1, avx512 = 2 };

// A body of code for one set: everything between BEGIN and END is compiled for it, in a namespace of its own. The body
// is a file that is included once per set; it must be compiled for the set from its first line, because compilers take
// comparisons of vectors apart early. kWidth is how many reals a register holds. Headers do not belong inside.
#if defined(__x86_64__) && defined(__clang__)
#define INTARSIA_BEGIN_AVX2 \
  _Pragma("clang attribute push(__attribute__((target(\"avx2\"))), apply_to = function)") namespace avx2 {
#define INTARSIA_BEGIN_AVX512 \
  _Pragma(                    \
      "clang attribute push(__attribute__((target(\"avx512dq,avx512vl\"))), apply_to = function)") namespace avx512 {
#define INTARSIA_END_SET \
  }                      \
  _Pragma("clang attribute pop")
#elif defined(__x86_64__) && defined(__GNUC__)
#define INTARSIA_BEGIN_AVX2 _Pragma("GCC push_options") _Pragma("GCC target(\"avx2\")") namespace avx2 {
#define INTARSIA_BEGIN_AVX512 \
  _Pragma("GCC push_options") _Pragma("GCC target(\"avx512dq,avx512vl\")") namespace avx512 {
#define INTARSIA_END_SET \
  }                      \
  _Pragma("GCC pop_options")
#else
#define INTARSIA_BEGIN_AVX2 namespace avx2 {
#define INTARSIA_BEGIN_AVX512 namespace avx512 {
#define INTARSIA_END_SET }
#endif
#define INTARSIA_INLINE inline __attribute__((always_inline))

// The widest set that this processor runs.
inline InstructionSet instruction_set() {
#if defined(__x86_64__) && defined(__GNUC__)
  static const InstructionSet widest =
      __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")
          ? InstructionSet::avx512
      : __builtin_cpu_supports("avx2") ? InstructionSet::avx2
                                       : InstructionSet::baseline;
  return widest;
#else
  return InstructionSet::baseline;
#endif
}

}  // namespace intarsia
