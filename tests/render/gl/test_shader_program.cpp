#include <doctest/doctest.h>

#include "engine/error.h"
#include "render/context/context.h"
#include "render/gl/shader_program.h"

namespace clatter {

TEST_CASE("Shader program: a mistake in a shader is reported with file and line") {
  const auto context = open_context(Backend::Auto);
  const char* source = "#version 330 core\nvoid main() {\n  nonsense;\n}\n";
  CHECK_THROWS_WITH_AS(compile_shader(context->gl(), GL_FRAGMENT_SHADER, "wrong.frag", source),
                       doctest::Contains("wrong.frag:3: "), RunError);
}

}  // namespace clatter
