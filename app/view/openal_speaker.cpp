#include "app/view/openal_speaker.h"

#include <AL/al.h>
#include <AL/alc.h>
#include <AL/alext.h>

#include <array>

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

}  // namespace clatter
