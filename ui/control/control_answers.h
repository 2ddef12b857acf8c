/// @file  Answers the requests of the control channel, frame by frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/imaging/frame.h"
#include "ui/control/control_channel.h"
#include "ui/state/app_view.h"
#include "ui/state/command.h"
#include "ui/state/window_state.h"
#include "ui/widgets/draw_record.h"
#include "ui/widgets/item_places.h"
#include "ui/window/canvas.h"

namespace flytri::ui {

/// A frame that is drawn but not shown yet.
struct DrawnFrame {
  const AppView& view;
  const WindowState& state;
  const ItemPlaces& places;
  const DrawRecord& record;
  std::vector<Command> commands;  ///< given in this frame
  const Canvas& canvas;
  ImageSize size;
  float scale = 1.0F;
  bool input_is_empty = true;  ///< no input waits for later frames
};

/// Does at once what a request asks for; nothing if it only asks for an answer, or is unknown.
void carry_out_request(const std::string& request, const AppView& view, WindowState& state,
                       std::vector<Command>& commands);

class ControlAnswers {
 public:
  explicit ControlAnswers(ControlChannel channel) : channel_(std::move(channel)) {}

  /// Before a frame is drawn: takes the next request, if the last one is answered, and performs its
  /// action.
  void ask(const AppView& view, WindowState& state, std::vector<Command>& commands);
  /// After it is drawn: sends the answer, if it is known.
  void answer(const DrawnFrame& frame);

 private:
  void begin(const std::string& request, const AppView& view, WindowState& state,
             std::vector<Command>& commands);
  [[nodiscard]] std::optional<std::string> answer_to(const DrawnFrame& frame);
  [[nodiscard]] std::string state_as_json(const DrawnFrame& frame);

  ControlChannel channel_;
  std::optional<std::string> verb_;  ///< of the request that is not answered yet
  std::string rest_;                 ///< its words after the verb
  int frames_left_ = 0;
  std::uint64_t frame_number_ = 0;
  std::vector<std::string> commands_;  ///< given since the state was last asked for
};

}  // namespace flytri::ui
