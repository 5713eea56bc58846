// Symmetric positive matrices whose rows are stored from their first entry up to the diagonal: the envelope (A. George
// and J. W. Liu, "Computer Solution of Large Sparse Positive Definite Systems", Prentice-Hall 1981, chapter 4). Its
// decomposition has no entry outside of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace mrpbench::slam {

class Envelope {
 public:
  /// `first[i]` is the column of the first entry of row i.
  explicit Envelope(std::vector<std::size_t> first) : first_(std::move(first)), begin_(first_.size() + 1) {
    for (std::size_t row = 0; row < first_.size(); ++row) begin_[row + 1] = begin_[row] + (row - first_[row] + 1);
    values_.resize(begin_.back());
  }

  std::size_t size() const { return first_.size(); }
  /// An entry of the lower half, within the envelope.
  double& at(std::size_t row, std::size_t column) { return values_[begin_[row] + column - first_[row]]; }
  double at(std::size_t row, std::size_t column) const { return values_[begin_[row] + column - first_[row]]; }
  void clear() { std::fill(values_.begin(), values_.end(), 0.0); }

  /// Replace the matrix by its Cholesky factor; false if it is not positive.
  bool decompose() {
    for (std::size_t row = 0; row < size(); ++row) {
      for (std::size_t column = first_[row]; column <= row; ++column) {
        const std::size_t from = std::max(first_[row], first_[column]);
        double sum = at(row, column);
        for (std::size_t k = from; k < column; ++k) sum -= at(row, k) * at(column, k);
        if (column < row) {
          at(row, column) = sum / at(column, column);
        } else if (sum > 0) {
          at(row, row) = std::sqrt(sum);
        } else {
          return false;
        }
      }
    }
    return true;
  }

  /// Solve with the factor; `x` holds the right side, then the solution.
  void solve(std::vector<double>& x) const {
    for (std::size_t row = 0; row < size(); ++row) {
      for (std::size_t k = first_[row]; k < row; ++k) x[row] -= at(row, k) * x[k];
      x[row] /= at(row, row);
    }
    for (std::size_t row = size(); row-- > 0;) {
      x[row] /= at(row, row);
      for (std::size_t k = first_[row]; k < row; ++k) x[k] -= at(row, k) * x[row];
    }
  }

 private:
  std::vector<std::size_t> first_, begin_;
  std::vector<double> values_;
};

}  // namespace mrpbench::slam
