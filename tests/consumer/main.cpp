// Lays patches on a cube: there must be six.
#include <cstdio>

#include <intarsia/intarsia.h>

int main() {
  constexpr int n = 8;  // squares along an edge
  std::vector<double> positions;
  std::vector<std::int32_t> triangles;
  for (int side = 0; side < 6; ++side)  // each with vertices of its own: they are welded
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        const double u[3] = {double(i) / n, double(j) / n, side < 3 ? 0.0 : 1.0};
        for (int axis = 0; axis < 3; ++axis) positions.push_back(u[(axis + side) % 3]);
        if (i == n || j == n) continue;
        const int a = (side * (n + 1) + i) * (n + 1) + j, b = a + 1, c = a + n + 1, d = c + 1;
        triangles.insert(triangles.end(), {a, c, d, a, d, b});
      }
  const auto result = intarsia::layout({positions, triangles});
  std::printf("intarsia %s: %zu patches %s\n", intarsia::version(), result->patches.size(),
              result.status.message.c_str());
  return result && result->patches.size() == 6 ? 0 : 1;
}
