/* SPDX-License-Identifier: MIT */
/* Bullet: a discrete dynamics world. Single precision, as Debian builds it. */
#include <btBulletDynamicsCommon.h>

#include "heaps.hpp"

namespace
{

using namespace heaps;

class Bullet : public Heap
{
  public:
    explicit Bullet(const std::vector<Start> &boxes)
        : dispatcher_(&configuration_),
          world_(&dispatcher_, &broadphase_, &solver_, &configuration_),
          box_(btVector3(0.5f, 0.5f, 0.5f)), plane_(btVector3(0, 0, 1), 0)
    {
        btVector3 inertia;

        world_.setGravity(btVector3(0, 0, static_cast<btScalar>(GRAVITY)));
        box_.calculateLocalInertia(1, inertia);
        add(0, &plane_, btVector3(0, 0, 0), btTransform::getIdentity());
        for (const Start &start : boxes) {
            const double *q = start.quaternion, *x = start.position;
            const btQuaternion turn(static_cast<btScalar>(q[1]), static_cast<btScalar>(q[2]),
                                    static_cast<btScalar>(q[3]), static_cast<btScalar>(q[0]));

            add(1, &box_, inertia,
                btTransform(turn,
                            btVector3(static_cast<btScalar>(x[0]), static_cast<btScalar>(x[1]),
                                      static_cast<btScalar>(x[2]))));
        }
    }
    ~Bullet() override
    {
        for (const auto &body : bodies_) {
            world_.removeRigidBody(body.get());
        }
    }
    const char *name() const override
    {
        return "bullet";
    }
    void step() override
    {
        world_.stepSimulation(static_cast<btScalar>(STEP), 0);
    }
    double height(int box) const override
    {
        return static_cast<double>(
            bodies_[static_cast<size_t>(box) + 1]->getWorldTransform().getOrigin().z());
    }

  private:
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_;
    btBoxShape box_;
    btStaticPlaneShape plane_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;

    void add(int mass, btCollisionShape *shape, const btVector3 &inertia, const btTransform &start)
    {
        btRigidBody::btRigidBodyConstructionInfo info(static_cast<btScalar>(mass), nullptr, shape,
                                                      inertia);

        info.m_startWorldTransform = start;
        info.m_friction = static_cast<btScalar>(0.70710678); /* Bullet multiplies both */
        bodies_.push_back(std::make_unique<btRigidBody>(info));
        bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
        world_.addRigidBody(bodies_.back().get());
    }
};

} // namespace

heaps::Made heaps::make_bullet(const std::vector<Start> &boxes)
{
    return std::make_unique<Bullet>(boxes);
}
