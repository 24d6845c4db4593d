#include "tools/web/live_frames.hpp"

#include <fmt/format.h>

#include <charconv>
#include <random>

#include "tools/web/feed_json.hpp"
#include "tools/web/state_json.hpp"

namespace bladefit {
namespace {

std::string random_name() {
  std::random_device device;
  return fmt::format("{:08x}{:08x}", device(), device());
}

/// Reads "-NUMBER" off the front of a text.
template <class Number>
bool take_number(std::string_view& text, Number& number) {
  if (!text.starts_with('-')) return false;
  const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), number);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

}  // namespace

LiveFrames::LiveFrames(const WebSource& source, bool commands)
    : source_(source), commands_(commands), run_(random_name()) {}

std::string LiveFrames::hello() const {
  return fmt::format("event: hello\ndata: {{\"run\":\"{}\",\"begun\":{}}}\n\n", run_, source_.feed->begun_ms());
}

std::chrono::steady_clock::time_point LiveFrames::next_tick() {
  const Clock::duration since = Clock::now().time_since_epoch();
  return Clock::time_point((since / kTick + 1) * std::chrono::duration_cast<Clock::duration>(kTick));
}

LiveFrames::Points LiveFrames::make_points(const FeedPlace& from) {
  const FeedPiece piece = source_.feed->read(from, room_);
  Points made{.text = nullptr, .next = piece.next, .more = piece.more};
  if (piece.count == 0 && !piece.afresh) return made;
  const FeedPlace& next = piece.next;
  made.text = std::make_shared<const std::string>(fmt::format("id: {}-{}-{}-{}\nevent: points\ndata: {}\n\n", run_,
                                                              next.cleared, next.slot, next.change,
                                                              piece_json(piece, std::span(room_).first(piece.count))));
  return made;
}

LiveFrames::Points LiveFrames::points(const FeedPlace& from) {
  const std::lock_guard lock(points_mutex_);
  // The beginning is not kept: what comes after it changes.
  const bool begins = from == FeedPlace{};
  for (const Kept& kept : kept_) {
    if (!begins && kept.points.text && kept.from == from) return kept.points;
  }
  Points made = make_points(from);
  if (made.text && !begins) {
    kept_[turn_] = {from, made};
    turn_ = (turn_ + 1) % kKept;
  }
  return made;
}

LiveFrames::State LiveFrames::state() {
  const std::lock_guard lock(state_mutex_);
  const Clock::time_point now = Clock::now();
  if (state_.text && now - made_ < kState) return state_;
  made_ = now;
  std::string text = fmt::format("event: state\ndata: {}\n\n", state_json(source_.state(), commands_));
  if (!state_.text || text != *state_.text)
    state_ = {std::make_shared<const std::string>(std::move(text)), state_.number + 1};
  return state_;
}

FeedPlace LiveFrames::place_of(const std::string& id) const {
  FeedPlace place;
  std::string_view rest = id;
  if (!rest.starts_with(run_)) return {};
  rest.remove_prefix(run_.size());
  const bool good =
      take_number(rest, place.cleared) && take_number(rest, place.slot) && take_number(rest, place.change);
  return good && rest.empty() ? place : FeedPlace{};
}

}  // namespace bladefit
