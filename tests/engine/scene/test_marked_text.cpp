#include <doctest/doctest.h>

#include "engine/scene/marked_text.h"

namespace clatter {

using Runs = std::vector<TextRun>;

TEST_CASE("Marked text: a mark lowers or raises one letter, or those in braces") {
  CHECK(marked_text("").runs.empty());
  CHECK(marked_text("plain {text}").runs == Runs{{"plain {text}", TextRun::Base}});
  CHECK(marked_text("T_x = m⟨v_x^2⟩").runs == Runs{{"T", TextRun::Base},
                                                   {"x", TextRun::Below},
                                                   {" = m⟨v", TextRun::Base},
                                                   {"x", TextRun::Below},
                                                   {"2", TextRun::Above},
                                                   {"⟩", TextRun::Base}});
  CHECK(marked_text("T_{refined}^α").runs ==
        Runs{{"T", TextRun::Base}, {"refined", TextRun::Below}, {"α", TextRun::Above}});
  CHECK(marked_text("_a").runs == Runs{{"a", TextRun::Below}});
}

TEST_CASE("Marked text: a backslash writes a mark") {
  CHECK(marked_text(R"(view\_speed, a\^b \\ \{)").runs ==
        Runs{{R"(view_speed, a^b \ {)", TextRun::Base}});
  CHECK(marked_text(R"(a_\_b_{\}}\n)").runs == Runs{{"a", TextRun::Base},
                                                    {"_", TextRun::Below},
                                                    {"b", TextRun::Base},
                                                    {"}", TextRun::Below},
                                                    {R"(\n)", TextRun::Base}});
  CHECK(marked_text(R"(a\)").runs == Runs{{R"(a\)", TextRun::Base}});
}

TEST_CASE("Marked text: incomplete marks are named") {
  CHECK(marked_text("T_x, v^{2}").problem.empty());
  for (const char* text : {"T_", "T_ x", "v^_2"}) {
    CHECK(marked_text(text).problem == "a '_' or '^' has no letter after it");
  }
  CHECK(marked_text("T_{x").problem == "a '{' has no '}'");
  CHECK(marked_text("T_{x_y}").problem == "a sub- or superscript contains another one");
}

}  // namespace clatter
