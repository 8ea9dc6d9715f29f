#include "calib/solve/linear.h"

#include <algorithm>
#include <cmath>

#include "render/base/check.h"

namespace calib {

cv::Mat_<double> product(const cv::Mat_<double>& a, const cv::Mat_<double>& b) {
  cv::Mat_<double> out;
  cv::gemm(a, b, 1.0, cv::noArray(), 0.0, out);
  return out;
}

cv::Mat_<double> transposed_product(const cv::Mat_<double>& a, const cv::Mat_<double>& b) {
  cv::Mat_<double> out;
  cv::gemm(a, b, 1.0, cv::noArray(), 0.0, out, cv::GEMM_1_T);
  return out;
}

cv::Mat_<double> solve_symmetric(const cv::Mat_<double>& a, const cv::Mat_<double>& b) {
  CHECK(a.rows == a.cols);
  CHECK(a.rows == b.rows);
  cv::Mat_<double> scaled = a.clone();
  cv::Mat_<double> right = b.clone();
  cv::Mat_<double> scale(a.rows, 1);
  for (int i = 0; i < a.rows; ++i) scale(i) = a(i, i) > 0.0 ? 1.0 / std::sqrt(a(i, i)) : 1.0;
  for (int r = 0; r < a.rows; ++r) {
    for (int c = 0; c < a.cols; ++c) scaled(r, c) *= scale(r) * scale(c);
    for (int c = 0; c < b.cols; ++c) right(r, c) *= scale(r);
  }
  cv::Mat_<double> x;
  if (!cv::solve(scaled, right, x, cv::DECOMP_CHOLESKY)) cv::solve(scaled, right, x, cv::DECOMP_SVD);
  for (int r = 0; r < x.rows; ++r) {
    for (int c = 0; c < x.cols; ++c) x(r, c) *= scale(r);
  }
  return x;
}

SymmetricEigen symmetric_eigen(const cv::Mat_<double>& a) {
  CHECK(a.rows == a.cols);
  cv::Mat_<double> values;
  cv::Mat_<double> rows;
  cv::eigen(a, values, rows);  // falling, vectors in rows
  SymmetricEigen out;
  cv::flip(values, out.values, 0);
  cv::flip(rows, rows, 0);
  cv::transpose(rows, out.vectors);
  return out;
}

cv::Mat_<double> orthonormal_columns(const cv::Mat_<double>& a) {
  cv::Mat_<double> columns;  // as rows, which lie together in memory
  cv::transpose(a, columns);
  for (int i = 0; i < columns.rows; ++i) {
    cv::Mat_<double> column = columns.row(i);
    const double length = cv::norm(column);
    for (int twice = 0; twice < 2; ++twice) {
      for (int before = 0; before < i; ++before) {
        cv::scaleAdd(columns.row(before), -columns.row(before).dot(column), column, column);
      }
    }
    const double left = cv::norm(column);
    column *= left > 1e-12 * length ? 1.0 / left : 0.0;
  }
  cv::Mat_<double> out;
  cv::transpose(columns, out);
  return out;
}

bool all_finite(const cv::Mat_<double>& a) {
  return std::all_of(a.begin(), a.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace calib
