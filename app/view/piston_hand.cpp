#include "app/view/piston_hand.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/physics/theory.h"
#include "engine/scene/act_checks.h"

namespace clatter {

static double few_digits(double number) {
  return std::stod(fmt::format("{:.6g}", number));
}

// The innermost position for the hand, which compresses the gas to a share of the closest packing.
static double innermost(const Scene& scene) {
  constexpr double kShare = 0.9, kAbove = 1.001;
  const double packed =
      scene.box[0] * scene.packing_fraction() / (kShare * closest_packing(scene.dimension()));
  return std::max(packed, kAbove * least_piston_position(scene));
}

void PistonHand::use(Session& session, std::optional<double> wanted) {
  if (drag_ && drag_->run != session.frame().run) drag_.reset();
  if (drag_ && !wanted) release(session);
  if (!wanted) return;
  if (!drag_) drag_ = Drag{session.frame().run, {}};
  push(session, *wanted);
}

// A stroke begins where and when the one before ends. It is sent a little earlier.
void PistonHand::push(Session& session, double wanted) {
  constexpr double kStroke = 0.1, kLead = 0.04;  // seconds of playing
  constexpr double kSlowest = 0.05;              // box lengths per second of playing
  const Frame& frame = session.frame();
  if (!frame.plays || frame.backwards || !session.is_answered()) return;
  const Snapshot& gas = frame.snapshot;
  const PistonPlan plan =
      piston_plan(frame.scene->changes, gas.time, gas.box[0] - gas.piston_travel);
  if (plan.time > gas.time + kLead * frame.speed) return;
  const double duration = few_digits(kStroke * frame.speed);
  const double fastest = std::max(std::sqrt(gas.temperature), kSlowest * gas.box[0] / frame.speed);
  const double way = fastest * duration;
  const double lowest = std::min(innermost(session.scene()), plan.position);
  const double position = few_digits(
      std::clamp(std::clamp(wanted, plan.position - way, plan.position + way), lowest, gas.box[0]));
  if (position == few_digits(plan.position)) return;
  session.move_piston(position, duration);
  drag_->acts.push_back({.piston = position});
}

void PistonHand::release(Session& session) {
  Drag drag = *std::exchange(drag_, std::nullopt);
  if (!drag.acts.empty()) return session.remember({.acts = std::move(drag.acts)});
  if (!session.frame().plays) {
    session.report("The piston moves while the gas plays; Shift + drag makes another box");
  }
}

}  // namespace clatter
