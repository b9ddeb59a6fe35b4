#include "fit/inner_product.hpp"

#include <gtest/gtest.h>

#include "cache_sizes.hpp"

namespace sweepface {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

TEST(InnerProduct, IsTheProductOfTheTransposed) {
  for (const int rows : {0, 1, 119, 120, 121, 1000}) {
    const Matrix a = Matrix::Random(rows, 36), b = Matrix::Random(rows, 50);
    const Matrix product = innerProduct(a, b);
    ASSERT_EQ(product.rows(), 36);
    ASSERT_EQ(product.cols(), 50);
    EXPECT_LE((product - a.transpose().lazyProduct(b)).norm(), 1e-12 * (1 + product.norm()))
        << rows;
  }
}

TEST(InnerProduct, IsTheSameToTheBitForCachesOfAnySize) {
  const Matrix a = Matrix::Random(1000, 36), b = Matrix::Random(1000, 177);
  const Matrix expected = innerProduct(a, b);
  for (const std::ptrdiff_t first : {16 << 10, 32 << 10, 48 << 10, 128 << 10}) {
    const testing::CacheSizes sizes(first, 16 * first, 64 * first);
    EXPECT_EQ(innerProduct(a, b), expected) << first;
  }
}

}  // namespace
}  // namespace sweepface
