#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/view/host.h"
#include "render/sound/live_sound.h"

namespace clatter {

/// The usual sound device of the system, by OpenAL. All calls come from one thread.
class OpenAlSpeaker final : public Loudspeaker {
 public:
  OpenAlSpeaker();
  ~OpenAlSpeaker() override;

  void open() override;
  std::string play(const std::vector<std::shared_ptr<const PlayedStretch>>& played) override;
  void close() override;

 private:
  class Queue;

  LiveSound sound_;
  std::unique_ptr<Queue> queue_;  // absent: closed
};

}  // namespace clatter
