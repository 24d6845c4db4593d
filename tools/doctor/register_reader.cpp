#include "tools/doctor/register_reader.hpp"

#include <algorithm>
#include <thread>

#include "drivers/modbus/cmm_requests.hpp"

namespace bladefit {
namespace {

constexpr int kTries = 3;

}  // namespace

RegisterReader::RegisterReader(const ModbusSettings& settings, Deadline until)
    : link_(make_modbus_link(settings)), until_(until) {}

Failure RegisterReader::connect() {
  if (Failure failure = link_->prepare()) return failure;
  link_->start_connect();
  LinkEvent event = LinkEvent::pending;
  while (event == LinkEvent::pending && ModbusLink::Clock::now() < until_) event = link_->connect(until_);
  if (event == LinkEvent::done) return {};
  return device_failure(event == LinkEvent::pending
                            ? "it does not take the connection in the time given; raise --timeout"
                            : link_->fault());
}

const RegisterReply& RegisterReader::read(RegisterTable table, std::uint16_t address, std::uint16_t count) {
  const auto [place, is_new] = replies_.try_emplace({table, address, count});
  if (!is_new) return place->second;
  CmmMap map;
  map.table = table;
  place->second = ask(read_request(map, address, count));
  return place->second;
}

RegisterReply RegisterReader::ask(const ModbusRequest& request) {
  RegisterReply reply;
  reply.registers.resize(request.count);
  for (int tries = 0; tries < kTries && ModbusLink::Clock::now() < until_; ++tries) {
    if (!link_->is_open() && connect()) break;
    reply.event = exchange(request, reply);
    const bool final = reply.event == LinkEvent::done || reply.event == LinkEvent::refused ||
                       reply.event == LinkEvent::unknown || reply.event == LinkEvent::absent;
    if (final) break;
  }
  if (reply.good()) return reply;
  reply.registers.clear();
  reply.fault = link_->fault().empty() ? "the time given is over; raise --timeout" : link_->fault();
  return reply;
}

LinkEvent RegisterReader::exchange(const ModbusRequest& request, RegisterReply& reply) {
  std::this_thread::sleep_until(std::min(until_, link_->ready_at()));
  if (link_->send(request) != LinkEvent::done) return LinkEvent::broken;
  LinkEvent event = LinkEvent::pending;
  while (event == LinkEvent::pending && ModbusLink::Clock::now() < until_)
    event = link_->receive(reply.registers, until_);
  return event == LinkEvent::pending ? LinkEvent::timeout : event;
}

}  // namespace bladefit
