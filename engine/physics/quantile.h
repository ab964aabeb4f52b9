#pragma once

namespace clatter {

/// The value z below which a standard normal variable, cut at -3 and 3, is with a probability of
/// 0..1. The error is below 1e-12. It uses + - * / only, so that every machine has the same bits.
double cut_normal_quantile(double probability);

/// exp(x) for |x| <= 20 with a relative error below 1e-12, with the same bits on every machine.
double exponential(double x);

}  // namespace clatter
