#include "tests/bench/peers/peer.hpp"

#include <iterator>
#include <utility>

namespace bladefit::bench {

std::vector<Peer> all_peers(const UnitSurface& surface, int outward) {
  std::vector<Peer> all;
  const auto add = [&all](std::vector<Peer> peers) {
    all.insert(all.end(), std::make_move_iterator(peers.begin()), std::make_move_iterator(peers.end()));
  };
  add(textbook_peers(surface, outward));
  add(opencascade_peers(surface));
  add(sisl_peers(surface));
  add(ceres_peers(surface, outward));
  add(nlopt_peers(surface, outward));
  add(ipopt_peers(surface, outward));
  return all;
}

}  // namespace bladefit::bench
