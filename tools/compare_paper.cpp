/* SPDX-License-Identifier: MIT */
/* The paper's interference detection; see tests/paper. The engine uses it only with PAPER=1. */
#include <cmath>

#include "compare.hpp"

extern "C" {
#include "paper/paper.h"
}

namespace
{

using namespace compare;

carom_m3_q30 matrix_of(const double q[4])
{
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const double rows[3][3] = {
        {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
        {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
        {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)},
    };
    carom_m3_q30 m;

    for (int i = 0; i < 9; i++) {
        m.c[i / 3][i % 3] = static_cast<int32_t>(std::lround(std::ldexp(rows[i / 3][i % 3], 30)));
    }
    return m;
}

class Paper : public Contender, private paper_visitor
{
  public:
    Paper(const Mesh &moving, const Mesh &still) : paper_visitor{note}
    {
        const double straight[4] = {1, 0, 0, 0};

        axes_ = matrix_of(straight);
        moving_ = {&moving.carom, &turned_, {0, 0, 0}};
        still_ = {&still.carom, &axes_, {0, 0, 0}};
    }
    const char *name() const override
    {
        return "paper";
    }
    size_t stride() const override
    {
        return 10;
    }
    void place(const Pose &pose) override
    {
        turned_ = matrix_of(pose.quaternion);
        for (int k = 0; k < 3; k++) {
            moving_.at_q20[k] = static_cast<int32_t>(pose.state.position.c[k] >> 12);
        }
    }
    void query() override
    {
        pairs_.clear();
        paper_pairs(&moving_, &still_, this);
    }
    size_t found() const override
    {
        return pairs_.size();
    }
    std::vector<Pair> pairs() const override
    {
        return pairs_;
    }

  private:
    carom_m3_q30 axes_, turned_;
    paper_placed moving_, still_;
    std::vector<Pair> pairs_;

    static void note(paper_visitor *self, uint16_t face_a, uint16_t face_b)
    {
        static_cast<Paper *>(self)->pairs_.push_back({face_a, face_b});
    }
};

} // namespace

compare::Made compare::make_paper(const Mesh &moving, const Mesh &still)
{
    return std::make_unique<Paper>(moving, still);
}
