#include "app/view/desktop.h"

#define GLFW_INCLUDE_NONE
#include <AL/al.h>
#include <AL/alc.h>
#include <AL/alext.h>
#include <GLFW/glfw3.h>

#include <array>
#include <cctype>

#include "engine/error.h"

namespace clatter {

// An open device and its queue of samples.
class OpenAlSpeaker::Queue {
 public:
  Queue() : device_(alcOpenDevice(nullptr)) {
    constexpr std::array<ALCint, 3> kRate = {ALC_FREQUENCY, kSampleRate, 0};
    if (device_) context_.reset(alcCreateContext(device_.get(), kRate.data()));
    if (!context_) throw RunError("no device for sound can be opened, so the sound stays off");
    alcMakeContextCurrent(context_.get());
    alGenSources(1, &source_);
    // Left and right go to the loudspeakers as they are.
    alSourcei(source_, AL_DIRECT_CHANNELS_SOFT, AL_TRUE);
  }
  Queue(const Queue&) = delete;
  Queue& operator=(const Queue&) = delete;
  ~Queue() {
    if (!source_) return;
    alSourceStop(source_);
    drop_played();
    alDeleteSources(1, &source_);
    alcMakeContextCurrent(nullptr);
  }

  // Number of samples that were not played yet.
  long waiting() {
    drop_played();
    ALint offset = 0;
    alGetSourcei(source_, AL_SAMPLE_OFFSET, &offset);
    return queued_ - offset;
  }

  void add(const std::vector<StereoSample>& samples) {
    if (samples.empty()) return;
    ALuint buffer = 0;
    alGenBuffers(1, &buffer);
    alBufferData(buffer, AL_FORMAT_STEREO16, samples.data(),
                 static_cast<ALsizei>(samples.size() * sizeof(StereoSample)), kSampleRate);
    alSourceQueueBuffers(source_, 1, &buffer);
    queued_ += static_cast<long>(samples.size());
    ALint state = 0;
    alGetSourcei(source_, AL_SOURCE_STATE, &state);
    if (state != AL_PLAYING) alSourcePlay(source_);
  }

 private:
  struct CloseDevice {
    void operator()(ALCdevice* device) const { alcCloseDevice(device); }
  };
  struct DestroyContext {
    void operator()(ALCcontext* context) const { alcDestroyContext(context); }
  };

  // Removes the buffers that were played.
  void drop_played() {
    ALint played = 0;
    alGetSourcei(source_, AL_BUFFERS_PROCESSED, &played);
    for (; played > 0; --played) {
      ALuint buffer = 0;
      ALint bytes = 0;
      alSourceUnqueueBuffers(source_, 1, &buffer);
      alGetBufferi(buffer, AL_SIZE, &bytes);
      alDeleteBuffers(1, &buffer);
      queued_ -= bytes / static_cast<long>(sizeof(StereoSample));
    }
  }

  std::unique_ptr<ALCdevice, CloseDevice> device_;
  std::unique_ptr<ALCcontext, DestroyContext> context_;
  ALuint source_ = 0;
  long queued_ = 0;  // samples in the buffers of the source
};

OpenAlSpeaker::OpenAlSpeaker() = default;

OpenAlSpeaker::~OpenAlSpeaker() = default;

void OpenAlSpeaker::open() {
  queue_ = std::make_unique<Queue>();
}

std::string OpenAlSpeaker::play(const std::vector<std::shared_ptr<const PlayedStretch>>& played) {
  queue_->add(sound_.next(played, queue_->waiting()));
  return {};
}

void OpenAlSpeaker::close() {
  queue_.reset();
}

// The letter, comma or period of a key in the current keyboard layout; 0: another sign. Alphabets
// without such letters have those of a US keyboard.
static char sign_of(int key) {
  if (key > GLFW_KEY_WORLD_2) return 0;
  const char* name = glfwGetKeyName(key, 0);
  const bool on_us = key >= GLFW_KEY_A && key <= GLFW_KEY_Z;
  const int sign = name && !name[1] ? name[0] : on_us ? key : 0;
  return std::isalpha(sign) || sign == ',' || sign == '.' ? static_cast<char>(std::tolower(sign))
                                                          : 0;
}

Desktop::Desktop(GLFWwindow* window, WindowInput& input) : window_(window) {
  glfwSetWindowUserPointer(window, &input);
  glfwSetKeyCallback(window, [](GLFWwindow* of, int key, int, int action, int held) {
    if (action == GLFW_RELEASE || key == GLFW_KEY_UNKNOWN) return;
    const KeyPress press{key, sign_of(key), (held & GLFW_MOD_SHIFT) != 0,
                         (held & GLFW_MOD_CONTROL) != 0};
    if (action == GLFW_REPEAT && !repeats(press)) return;
    static_cast<WindowInput*>(glfwGetWindowUserPointer(of))->press(press);
  });
  glfwSetCharCallback(window, [](GLFWwindow* of, unsigned character) {
    static_cast<WindowInput*>(glfwGetWindowUserPointer(of))->type(character);
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow* of, double x, double y) {
    static_cast<WindowInput*>(glfwGetWindowUserPointer(of))->move_mouse(x, y);
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* of, int, int action, int) {
    if (action != GLFW_PRESS) return;
    static_cast<WindowInput*>(glfwGetWindowUserPointer(of))->press_mouse();
  });
  glfwSetDropCallback(window, [](GLFWwindow* of, int count, const char** paths) {
    auto* to = static_cast<WindowInput*>(glfwGetWindowUserPointer(of));
    for (int k = 0; k < count; ++k) to->drop(paths[k]);
  });
}

float Desktop::content_scale() const {
  float scale = 1.0f;
  glfwGetWindowContentScale(window_, &scale, nullptr);
  return scale;
}

void Desktop::set_title(const std::string& title) {
  glfwSetWindowTitle(window_, title.c_str());
}

void Desktop::copy(const std::string& text) {
  glfwSetClipboardString(window_, text.c_str());
}

void Desktop::toggle_full_screen() {
  auto& [x, y, width, height] = windowed_;
  if (glfwGetWindowMonitor(window_)) {
    glfwSetWindowMonitor(window_, nullptr, x, y, width, height, 0);
    return;
  }
  glfwGetWindowPos(window_, &x, &y);
  glfwGetWindowSize(window_, &width, &height);
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = glfwGetVideoMode(monitor);
  glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Desktop::close() {
  glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

}  // namespace clatter
