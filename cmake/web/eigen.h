#pragma once

// Sums of three numbers in the order that Eigen has with the vectors of x86 and ARM processors:
// (a + b) + c. Eigen has no vectors of WebAssembly, and its order without vectors is a + (b + c).
// The bits of spheres depend on it; tests/hash checks them. Every source of the page includes this
// file before others.

#include <Eigen/Core>

namespace Eigen::internal {

template <typename Func, typename Evaluator>
struct redux_novec_unroller<Func, Evaluator, 0, 3> {
  using Scalar = typename Evaluator::Scalar;

  template <int kIndex>
  using Term = redux_novec_unroller<Func, Evaluator, kIndex, 1>;

  static Scalar run(const Evaluator& terms, const Func& sum) {
    return sum(sum(Term<0>::run(terms, sum), Term<1>::run(terms, sum)), Term<2>::run(terms, sum));
  }
};

}  // namespace Eigen::internal
