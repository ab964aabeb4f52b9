#include "app/web/page_host.h"

#include <emscripten.h>

#include <cstdlib>

// clang-format off
EM_JS(double, page_scale, (), { return Module.page.scale(); })
EM_JS(double, page_target, (), { return Module.page.target(); })
EM_JS(void, page_title, (const char* title), { Module.page.title(UTF8ToString(title)); })
EM_JS(void, page_copy, (const char* text), { Module.page.copy(UTF8ToString(text)); })
EM_JS(void, page_full_screen, (), { Module.page.fullScreen(); })
EM_JS(void, page_deliver, (const char* file), { Module.page.deliver(UTF8ToString(file)); })
EM_JS(char*, page_link, (const char* fragment), {
  const link = Module.page.link(UTF8ToString(fragment));
  const size = lengthBytesUTF8(link) + 1;
  const text = _malloc(size);
  stringToUTF8(link, text, size);
  return text;
})
// clang-format on

namespace clatter {

// The style of the panels is for whole pixels of the device.
float PageHost::content_scale() const {
  return static_cast<float>(page_scale());
}

float PageHost::least_target() const {
  return static_cast<float>(page_target());
}

void PageHost::set_title(const std::string& title) {
  page_title(title.c_str());
}

void PageHost::copy(const std::string& text) {
  page_copy(text.c_str());
}

void PageHost::toggle_full_screen() {
  page_full_screen();
}

void PageHost::deliver(const std::string& file) {
  page_deliver(file.c_str());
}

std::string PageHost::link_to(const std::string& fragment) const {
  char* const text = page_link(fragment.c_str());
  std::string link(text);
  std::free(text);
  return link;
}

}  // namespace clatter
