#include "ui/sound/sound_player.h"

#include <AL/al.h>
#include <AL/alc.h>
#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstdio>

namespace flytri::ui {
namespace {

constexpr std::array kSounds = {Sound::kLost, Sound::kReturn};

// The sound libraries print a message for each missing device. While this exists, standard error
// is discarded.
class QuietStandardError {
 public:
  QuietStandardError() : kept_(::dup(STDERR_FILENO)), nowhere_(::open("/dev/null", O_WRONLY)) {
    std::fflush(stderr);
    if (kept_ >= 0 && nowhere_ >= 0) ::dup2(nowhere_, STDERR_FILENO);
  }
  QuietStandardError(const QuietStandardError&) = delete;
  QuietStandardError& operator=(const QuietStandardError&) = delete;
  ~QuietStandardError() {
    std::fflush(stderr);
    if (kept_ >= 0) {
      ::dup2(kept_, STDERR_FILENO);
      ::close(kept_);
    }
    if (nowhere_ >= 0) ::close(nowhere_);
  }

 private:
  int kept_, nowhere_;
};

struct CloseDevice {
  void operator()(ALCdevice* device) const { alcCloseDevice(device); }
};
struct DestroyContext {
  void operator()(ALCcontext* context) const {
    alcMakeContextCurrent(nullptr);
    alcDestroyContext(context);
  }
};

}  // namespace

// An open device with both sounds loaded.
struct SoundPlayer::Device {
  [[nodiscard]] static std::unique_ptr<Device> open();
  ~Device();
  [[nodiscard]] ALuint source(Sound sound) const {
    return sources[static_cast<std::size_t>(sound)];
  }

  std::unique_ptr<ALCdevice, CloseDevice> device;
  std::unique_ptr<ALCcontext, DestroyContext> context;
  std::array<ALuint, kSounds.size()> buffers{}, sources{};
};

std::unique_ptr<SoundPlayer::Device> SoundPlayer::Device::open() {
  const QuietStandardError quiet;
  auto opened = std::make_unique<Device>();
  opened->device.reset(alcOpenDevice(nullptr));
  if (!opened->device) return nullptr;
  opened->context.reset(alcCreateContext(opened->device.get(), nullptr));
  if (!opened->context || alcMakeContextCurrent(opened->context.get()) == ALC_FALSE) return nullptr;
  constexpr auto kCount = static_cast<ALsizei>(kSounds.size());
  alGenBuffers(kCount, opened->buffers.data());
  alGenSources(kCount, opened->sources.data());
  for (const Sound sound : kSounds) {
    const std::vector<std::int16_t> samples = synthesize(sound);
    const ALuint buffer = opened->buffers[static_cast<std::size_t>(sound)];
    alBufferData(buffer, AL_FORMAT_MONO16, samples.data(),
                 static_cast<ALsizei>(samples.size() * sizeof(std::int16_t)), kSampleRate_hz);
    alSourcei(opened->source(sound), AL_BUFFER, static_cast<ALint>(buffer));
  }
  return alGetError() == AL_NO_ERROR ? std::move(opened) : nullptr;
}

SoundPlayer::Device::~Device() {
  if (!context) return;
  alDeleteSources(static_cast<ALsizei>(sources.size()), sources.data());
  alDeleteBuffers(static_cast<ALsizei>(buffers.size()), buffers.data());
}

SoundPlayer::SoundPlayer() : device_(Device::open()) {}

SoundPlayer::~SoundPlayer() = default;

void SoundPlayer::set_muted(bool muted) {
  muted_ = muted;
  if (!device_ || !muted) return;
  for (const Sound sound : kSounds) alSourceStop(device_->source(sound));
}

void SoundPlayer::play(Sound sound) {
  if (!device_ || muted_) return;
  alSourceRewind(device_->source(sound));
  alSourcePlay(device_->source(sound));
}

}  // namespace flytri::ui
