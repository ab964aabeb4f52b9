#include "app/view/panels.h"

#include <algorithm>

namespace clatter {

bool gas_panels(Session& session, Controls& controls, MouseTools& tools,
                const std::vector<std::string>& titles) {
  gas_panel(session, controls);
  compare_panel(session, controls, titles);
  const bool takes_tool = tools.panel(session.scene(), controls);
  box_panel(session, controls);
  fixture_panel(session, controls);
  view_panel(session, controls);
  accuracy_panel(session, controls);
  return takes_tool;
}

void compare_panel(Session& session, Controls& controls, const std::vector<std::string>& titles) {
  if (!controls.group("Compare")) return;
  const bool compares = !titles.empty();
  if (compares) {
    int chosen = static_cast<int>(std::min(session.gas(), titles.size() - 1));
    if (controls.choice("compare.gas", "Gas",
                        "The gas that the panels change (N: the next one). A click on its picture "
                        "selects it too",
                        titles, chosen, chosen)) {
      session.select(static_cast<std::size_t>(chosen));
    }
  }
  const float width = ImGui::GetContentRegionAvail().x;
  if (controls.button("compare.add", "Add a copy",
                      "Runs a copy of this gas beside it, in step (C). Then change one of them",
                      width)) {
    session.add_copy();
  }
  if (compares && controls.button("compare.remove", "Remove this gas",
                                  "Ends its comparison with the others", width)) {
    session.remove_gas();
  }
}

}  // namespace clatter
