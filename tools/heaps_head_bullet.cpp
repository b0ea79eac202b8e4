/* SPDX-License-Identifier: MIT */
/* Bullet: the scene `head` of two GImpact meshes. Single precision, as Debian builds it. */
#include <cmath>

#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <btBulletDynamicsCommon.h>

#include "heaps.hpp"

namespace
{

using namespace heaps;

btVector3 vector_of(const double v[3])
{
    return btVector3(static_cast<btScalar>(v[0]), static_cast<btScalar>(v[1]),
                     static_cast<btScalar>(v[2]));
}

struct Shape {
    btTriangleIndexVertexArray mesh;
    btGImpactMeshShape shape;

    explicit Shape(Mesh &from)
        : mesh(static_cast<int>(from.faces.size()), from.faces[0].data(), sizeof from.faces[0],
               static_cast<int>(from.vertices.size()), from.vertices[0].data(),
               sizeof from.vertices[0]),
          shape(&mesh)
    {
        shape.setMargin(0);
        shape.updateBound();
    }
};

class Bullet : public Heap
{
  public:
    explicit Bullet(const Scene &scene)
        : scene_(scene), dispatcher_(&configuration_),
          world_(&dispatcher_, &broadphase_, &solver_, &configuration_), head_(scene_.head),
          field_(scene_.field), ground_(0, nullptr, &field_.shape, btVector3(0, 0, 0)),
          body_(1, nullptr, &head_.shape, vector_of(scene_.inertia))
    {
        btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher_);
        world_.setGravity(btVector3(0, 0, static_cast<btScalar>(GRAVITY)));
        for (btRigidBody *body : {&ground_, &body_}) {
            body->setFriction(
                static_cast<btScalar>(std::sqrt(scene_.friction))); /* Bullet multiplies both */
            body->setRestitution(static_cast<btScalar>(std::sqrt(scene_.restitution)));
            body->setActivationState(DISABLE_DEACTIVATION);
        }
        body_.setWorldTransform(
            btTransform(btQuaternion::getIdentity(), vector_of(scene_.start.position)));
        body_.setInterpolationWorldTransform(body_.getWorldTransform());
        body_.setLinearVelocity(vector_of(scene_.velocity));
        body_.setAngularVelocity(vector_of(scene_.spin));
        world_.addRigidBody(&ground_);
        world_.addRigidBody(&body_);
    }
    ~Bullet() override
    {
        world_.removeRigidBody(&body_);
        world_.removeRigidBody(&ground_);
    }
    const char *name() const override
    {
        return "bullet";
    }
    void step() override
    {
        world_.stepSimulation(static_cast<btScalar>(STEP), 0);
    }
    double height(int) const override
    {
        return static_cast<double>(body_.getWorldTransform().getOrigin().z());
    }

  private:
    Scene scene_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_;
    Shape head_, field_;
    btRigidBody ground_, body_;
};

} // namespace

heaps::Made heaps::make_bullet_head(const Scene &scene)
{
    return std::make_unique<Bullet>(scene);
}
