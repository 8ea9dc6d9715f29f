#pragma once

#include <opencv2/core.hpp>

namespace calib {

// Small dense linear algebra on OpenCV's matrices: what is not worth a header of templates in every file.

// x of a x = b for a symmetric positive definite `a`, scaled to unit diagonal first; the least squares solution of
// smallest norm where `a` is not regular.
cv::Mat_<double> solve_symmetric(const cv::Mat_<double>& a, const cv::Mat_<double>& b);

// Eigenvalues, rising, and the unit eigenvectors in the columns.
struct SymmetricEigen {
  cv::Mat_<double> values;   // n x 1
  cv::Mat_<double> vectors;  // n x n
};
SymmetricEigen symmetric_eigen(const cv::Mat_<double>& a);

// An orthonormal basis of the columns' space (modified Gram-Schmidt, twice); zero columns where they depend on those
// before.
cv::Mat_<double> orthonormal_columns(const cv::Mat_<double>& a);

cv::Mat_<double> product(const cv::Mat_<double>& a, const cv::Mat_<double>& b);
// a transposed times b.
cv::Mat_<double> transposed_product(const cv::Mat_<double>& a, const cv::Mat_<double>& b);

bool all_finite(const cv::Mat_<double>& a);

}  // namespace calib
