/* SPDX-License-Identifier: MIT */
/* FCL: two bounding volume hierarchies in double precision, every crossing face pair. */
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>

#include "compare.hpp"

namespace
{

using namespace compare;

using Model = fcl::BVHModel<fcl::OBBRSS<double>>;

std::shared_ptr<Model> model_of(const Mesh &mesh)
{
    auto model = std::make_shared<Model>();
    std::vector<fcl::Vector3<double>> vertices;
    std::vector<fcl::Triangle> faces;

    for (const auto &v : mesh.vertices) {
        vertices.emplace_back(v[0], v[1], v[2]);
    }
    for (const auto &f : mesh.faces) {
        faces.emplace_back(f[0], f[1], f[2]);
    }
    model->beginModel();
    model->addSubModel(vertices, faces);
    model->endModel();
    return model;
}

class Fcl : public Contender
{
  public:
    Fcl(const Mesh &moving, const Mesh &still)
        : moving_(model_of(moving)), still_(model_of(still)), request_(1 << 20, true)
    {
        still_.computeAABB();
    }
    const char *name() const override
    {
        return "fcl";
    }
    void place(const Pose &pose) override
    {
        const double *q = pose.quaternion, *x = pose.position;

        moving_.setTransform(fcl::Quaternion<double>(q[0], q[1], q[2], q[3]),
                             fcl::Vector3<double>(x[0], x[1], x[2]));
    }
    void query() override
    {
        result_.clear();
        moving_.computeAABB();
        if (moving_.getAABB().overlap(still_.getAABB())) {
            fcl::collide(&moving_, &still_, request_, result_);
        }
    }
    size_t found() const override
    {
        return result_.numContacts();
    }

  private:
    fcl::CollisionObject<double> moving_, still_;
    fcl::CollisionRequest<double> request_;
    fcl::CollisionResult<double> result_;
};

} // namespace

compare::Made compare::make_fcl(const Mesh &moving, const Mesh &still)
{
    return std::make_unique<Fcl>(moving, still);
}
