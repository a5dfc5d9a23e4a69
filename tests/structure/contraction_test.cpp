// a * b + c must be two roundings in every unit: fused multiply-add would make results depend on the processor.
#include <doctest/doctest.h>

TEST_CASE("products are rounded before they are added") {
  volatile double a = 1 + 0x1p-30, b = 1 - 0x1p-30, c = -1;
  const double x = a, y = b, z = c;
  CHECK(x * y + z == 0.0);  // exactly -2^-60 if fused
}
