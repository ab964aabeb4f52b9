#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/measure/feature_cost.h"
#include "app/view/panels.h"
#include "engine/scene/enum_names.h"
#include "engine/scene/key_rules.h"
#include "engine/scene/key_writer.h"

namespace clatter {

static void show_cost(Controls& controls, double price) {
  if (controls.chooses()) return;
  ImGui::TextDisabled("CPU time %s", cost_text(price).c_str());
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("Relative to the CPU time without it, measured for 1000 disks");
  }
}

static void show_share(Controls& controls, const char* key, const char* name, double share) {
  controls.note(key, fmt::format("{}: {}", name,
                                 std::isnan(share) ? "-" : fmt::format("{:.2g} %", 100.0 * share)));
}

static void contact_time(Session& session, Controls& controls) {
  constexpr double kUsual = 1e-5;
  const auto& time = session.scene().contact_time;
  const auto table = [](std::optional<double> t) {
    return t ? "{ contact_time = " + value_text(*t) + " }" : std::string("{}");
  };
  bool on = time.has_value();
  if (controls.toggle(
          "contact_time", "Contact time",
          "Collisions within t_c of the previous one are elastic; prevents inelastic collapse",
          on)) {
    controls.set({{"collapse", table(time)}},
                 {{"collapse", table(on ? std::optional(kUsual) : std::nullopt)}});
  } else if (on) {
    controls.law({.key = "collapse.contact_time",
                  .name = "Duration",
                  .symbol = "t_c",
                  .unit = "t",
                  .help = "Of the TC model. Its errors since the last change of laws are below: "
                          "undissipated over dissipated energy, and the share of elastic "
                          "collisions",
                  .low = 1e-9,
                  .high = 0.1,
                  .logarithmic = true,
                  .format = "%.1e"},
                 *time, session.opened().contact_time.value_or(kUsual));
  }
  show_cost(controls, kContactTimeCost);
  if (!on) return;
  // Shown even without a value, so that the panel keeps its height after a change of laws.
  const auto& error = session.frame().contact_time_error;
  show_share(controls, "not_dissipated", "Not dissipated",
             error ? error->undissipated : std::nan(""));
  show_share(controls, "elastic_collisions", "Elastic collisions",
             error ? error->elasticised : std::nan(""));
}

// List of estimators; the snapshot estimator adds a slider for its interval.
static bool choose_estimator(Controls& controls, View& view, const View& usual) {
  std::vector<std::string> words;
  for (const auto& [name, estimator] : kEstimators) {
    words.push_back(std::string(name) + "  " + cost_text(cost_of(estimator)));
  }
  int chosen = static_cast<int>(view.estimator);
  bool changed = controls.choice(
      "view.estimator", "Fields from",
      "Heatmap and arrows average whole flights of disks, or snapshots. The factor is the CPU time "
      "relative to a run without fields",
      words, chosen, static_cast<int>(usual.estimator));
  view.estimator = static_cast<Estimator>(chosen);
  if (view.estimator == Estimator::Snapshot) {
    changed |= controls.number({.key = "view.interval",
                                .name = "Snapshots every",
                                .unit = "t",
                                .help = "Time between two snapshots; long intervals give "
                                        "independent samples, short intervals more samples",
                                .low = 0.01,
                                .high = view.window,
                                .logarithmic = true},
                               view.interval, std::min(usual.interval, view.window));
  }
  return changed;
}

// Settings and cost of the averages in the view: fields or balance residuals.
static void averages(Session& session, Controls& controls) {
  View view = session.view();
  const View& usual = session.opened().view;
  bool changed = false;
  if (view.field && is_residual(*view.field) && !controls.chooses()) {
    ImGui::TextUnformatted("Balances");
    ImGui::SameLine();
    show_cost(controls, kBalanceCost);
  }
  if (view.arrows || (view.field && !is_residual(*view.field))) {
    changed |= choose_estimator(controls, view, usual);
  }
  if (view.shows_averages()) {
    changed |= controls.number({.key = "view.window",
                                .name = "Averaged over",
                                .unit = "t",
                                .help = "Averaging time of heatmap and arrows. A longer time gives "
                                        "less noise and more delay, at no CPU cost",
                                .low = 0.1,
                                .high = 100.0,
                                .logarithmic = true,
                                .format = "%.2f"},
                               view.window, usual.window);
    view.interval = std::min(view.interval, view.window);
  }
  controls.show(view, changed);
}

void accuracy_panel(Session& session, Controls& controls) {
  if (!controls.group("Accuracy")) return;
  contact_time(session, controls);
  averages(session, controls);
}

}  // namespace clatter
