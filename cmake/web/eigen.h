#pragma once

// Sums of three numbers in the order that Eigen has with the vectors of x86 and ARM processors:
// (a + b) + c. Eigen has no vectors of WebAssembly, and its order without vectors is a + (b + c).
// The bits of spheres depend on it; tests/hash checks them. Every source of the page includes this
// file before others.

#include <Eigen/Core>

namespace Eigen::internal {

template <typename Term0, typename Term1, typename Term2>
struct SumFromTheFirst {
  template <typename Evaluator, typename Func>
  static typename Evaluator::Scalar run(const Evaluator& terms, const Func& sum) {
    return sum(sum(Term0::run(terms, sum), Term1::run(terms, sum)), Term2::run(terms, sum));
  }
};

template <typename Func, typename Evaluator>
struct redux_novec_unroller<Func, Evaluator, 0, 3>
    : SumFromTheFirst<redux_novec_unroller<Func, Evaluator, 0, 1>,
                      redux_novec_unroller<Func, Evaluator, 1, 1>,
                      redux_novec_unroller<Func, Evaluator, 2, 1>> {};

// Eigen 5 has this struct too.
#if EIGEN_VERSION_AT_LEAST(5, 0, 0)
template <typename Func, typename Evaluator>
struct redux_novec_linear_unroller<Func, Evaluator, 0, 3>
    : SumFromTheFirst<redux_novec_linear_unroller<Func, Evaluator, 0, 1>,
                      redux_novec_linear_unroller<Func, Evaluator, 1, 1>,
                      redux_novec_linear_unroller<Func, Evaluator, 2, 1>> {};
#endif

}  // namespace Eigen::internal
