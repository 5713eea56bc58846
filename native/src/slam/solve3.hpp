// Three linear equations with a symmetric positive matrix.
#pragma once

#include <cmath>

namespace mrpbench::slam {

/// Solve by Cholesky's decomposition; the matrix is xx, xy, xt, yy, yt, tt. False if it is not positive.
inline bool solve3(const double (&m)[6], const double (&right)[3], double (&x)[3]) {
  if (!(m[0] > 0)) return false;
  const double a = std::sqrt(m[0]), b = m[1] / a, c = m[2] / a, d2 = m[3] - b * b;
  if (!(d2 > 0)) return false;
  const double d = std::sqrt(d2), e = (m[4] - b * c) / d, f2 = m[5] - c * c - e * e;
  if (!(f2 > 0)) return false;
  const double f = std::sqrt(f2), u = right[0] / a, v = (right[1] - b * u) / d, w = (right[2] - c * u - e * v) / f;
  x[2] = w / f;
  x[1] = (v - e * x[2]) / d;
  x[0] = (u - b * x[1] - c * x[2]) / a;
  return true;
}

}  // namespace mrpbench::slam
