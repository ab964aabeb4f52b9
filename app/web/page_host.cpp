#include "app/web/page_host.h"

#include <emscripten.h>

#include <cstdint>
#include <cstdlib>

#include "engine/error.h"

// clang-format off
EM_JS(double, page_scale, (), { return Module.page.scale(); })
EM_JS(double, page_target, (), { return Module.page.target(); })
EM_JS(void, page_title, (const char* title), { Module.page.title(UTF8ToString(title)); })
EM_JS(void, page_copy, (const char* text), { Module.page.copy(UTF8ToString(text)); })
EM_JS(void, page_full_screen, (), { Module.page.fullScreen(); })
EM_JS(void, page_deliver, (const char* file), { Module.page.deliver(UTF8ToString(file)); })
EM_JS(char*, page_begin_film, (int width, int height), {
  return stringToNewUTF8(Module.page.beginFilm(width, height));
})
EM_JS(char*, page_film_extension, (), { return stringToNewUTF8(Module.page.filmExtension()); })
EM_JS(char*, page_film, (int x, int y, int width, int height), {
  return stringToNewUTF8(Module.page.film(x, y, width, height));
})
EM_JS(void, page_end_film, (const char* name), { Module.page.endFilm(UTF8ToString(name)); })
EM_JS(char*, page_open_sound, (int rate), { return stringToNewUTF8(Module.page.openSound(rate)); })
EM_JS(int, page_waiting_sound, (), { return Module.page.waitingSound(); })
EM_JS(char*, page_play_sound, (const std::int16_t* samples, int count), {
  return stringToNewUTF8(
      Module.page.playSound(HEAP16.subarray(samples / 2, samples / 2 + 2 * count)));
})
EM_JS(void, page_close_sound, (), { Module.page.closeSound(); })
EM_JS(char*, page_link, (const char* fragment), {
  return stringToNewUTF8(Module.page.link(UTF8ToString(fragment)));
})
// clang-format on

namespace clatter {

// A copy of a text that the page has allocated.
static std::string taken(char* text) {
  std::string copy(text);
  std::free(text);
  return copy;
}

// Throws what the browser refuses, a text that the page has allocated; empty: nothing.
static void expect_allowed(char* refusal) {
  const std::string text = taken(refusal);
  if (!text.empty()) throw RunError(text);
}

void PageRecorder::begin(Size size) {
  expect_allowed(page_begin_film(size.width, size.height));
}

std::string PageRecorder::extension() const {
  return taken(page_film_extension());
}

std::string PageRecorder::add(int x, int y, Size size) {
  return taken(page_film(x, y, size.width, size.height));
}

void PageRecorder::end(const std::string& name) {
  page_end_film(name.c_str());
}

void PageSpeaker::open() {
  expect_allowed(page_open_sound(kSampleRate));
}

std::string PageSpeaker::play(const std::vector<std::shared_ptr<const PlayedStretch>>& played) {
  const std::vector<StereoSample> samples = sound_.next(played, page_waiting_sound());
  if (samples.empty()) return {};
  return taken(page_play_sound(samples.front().data(), static_cast<int>(samples.size())));
}

void PageSpeaker::close() {
  page_close_sound();
}

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
  return taken(page_link(fragment.c_str()));
}

}  // namespace clatter
