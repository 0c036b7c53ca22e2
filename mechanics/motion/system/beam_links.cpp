#include "mechanics/motion/system/beam_links.hpp"

#include <algorithm>

#include "mechanics/motion/system/room.hpp"

namespace vlbeam {

template <int D>
void BeamLinks<D>::adopt() {
  all_.clear();
  for (const Tie& tie : ties_) {
    const int behind = beam_.place_of(tie.behind).node, ahead = beam_.place_of(tie.ahead).node;
    for (int c = 0; c < D; ++c) all_.push_back({behind, ahead, tie.apart[c], Vector(Vector::Unit(c)), {}});
  }
  for (const auto& room : beam_.model().rooms) room->add_links(beam_, all_);
  tied_ = all_.size();
}

template <int D>
void BeamLinks<D>::carry(const double* q, const double* rate, double t) const {
  carried_.clear();
  for (const auto& room : beam_.model().rooms) room->add_carried(beam_.view(q, rate), t, carried_);
}

template <int D>
void BeamLinks<D>::set_resting(const std::vector<Link>& resting) {
  all_.resize(tied_);
  all_.insert(all_.end(), resting.begin(), resting.end());
}

template <int D>
void BeamLinks<D>::tie_blocks(const double* q) {
  for (const std::vector<int>& block : beam_.model().blocks) {
    for (std::size_t k = 1; k < block.size(); ++k) {
      const auto place = [&](int joint) { return position<D>(q, beam_.place_of(joint).node); };
      ties_.push_back({block[0], block[k], place(block[k]) - place(block[0])});
    }
  }
  adopt();
}

template <int D>
bool BeamLinks<D>::in_block(int index) const {
  return std::ranges::any_of(ties_, [index](const Tie& tie) { return tie.behind == index || tie.ahead == index; });
}

template <int D>
Eigen::VectorXd BeamLinks<D>::bending_in(const double* q, const double* rate, const std::vector<Link>& links) const {
  Eigen::VectorXd wanted(static_cast<Eigen::Index>(links.size()));
  const ChainView<D> beam = beam_.view(q, rate);
  for (std::size_t i = 0; i < links.size(); ++i) wanted[static_cast<Eigen::Index>(i)] = -links[i].turning(beam);
  return wanted;
}

template class BeamLinks<2>;
template class BeamLinks<3>;

}  // namespace vlbeam
