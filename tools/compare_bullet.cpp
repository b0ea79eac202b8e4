/* SPDX-License-Identifier: MIT */
/* Bullet: two GImpact meshes in a collision world. Single precision, as Debian builds it. */
#include <btBulletCollisionCommon.h>
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

#include "compare.hpp"

namespace
{

using namespace compare;

struct Body {
    std::vector<btScalar> vertices;
    std::vector<int> indices;
    std::unique_ptr<btTriangleIndexVertexArray> mesh;
    std::unique_ptr<btGImpactMeshShape> shape;
    btCollisionObject object;

    explicit Body(const Mesh &from)
    {
        for (const auto &v : from.vertices) {
            for (double c : v) {
                vertices.push_back(static_cast<btScalar>(c));
            }
        }
        for (const auto &f : from.faces) {
            indices.insert(indices.end(), f.begin(), f.end());
        }
        mesh = std::make_unique<btTriangleIndexVertexArray>(
            static_cast<int>(from.faces.size()), indices.data(), 3 * sizeof(int),
            static_cast<int>(from.vertices.size()), vertices.data(), 3 * sizeof(btScalar));
        shape = std::make_unique<btGImpactMeshShape>(mesh.get());
        shape->setMargin(0);
        shape->updateBound();
        object.setCollisionShape(shape.get());
        object.setActivationState(DISABLE_DEACTIVATION);
    }
};

class Bullet : public Contender
{
  public:
    Bullet(const Mesh &moving, const Mesh &still)
        : dispatcher_(&configuration_), world_(&dispatcher_, &broadphase_, &configuration_),
          moving_(moving), still_(still)
    {
        btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher_);
        still_.object.setCollisionFlags(btCollisionObject::CF_STATIC_OBJECT);
        moving_.object.setCollisionFlags(0);
        world_.addCollisionObject(&still_.object);
        world_.addCollisionObject(&moving_.object);
    }
    ~Bullet() override
    {
        world_.removeCollisionObject(&moving_.object);
        world_.removeCollisionObject(&still_.object);
    }
    const char *name() const override
    {
        return "bullet";
    }
    void place(const Pose &pose) override
    {
        const double *q = pose.quaternion, *x = pose.position;
        const btQuaternion turn(static_cast<btScalar>(q[1]), static_cast<btScalar>(q[2]),
                                static_cast<btScalar>(q[3]), static_cast<btScalar>(q[0]));
        const btVector3 at(static_cast<btScalar>(x[0]), static_cast<btScalar>(x[1]),
                           static_cast<btScalar>(x[2]));

        moving_.object.setWorldTransform(btTransform(turn, at));
    }
    void query() override
    {
        world_.performDiscreteCollisionDetection();
    }
    size_t found() const override
    {
        size_t points = 0;

        for (int i = 0; i < dispatcher_.getNumManifolds(); i++) {
            const btPersistentManifold *manifold =
                const_cast<btCollisionDispatcher &>(dispatcher_).getManifoldByIndexInternal(i);

            points += static_cast<size_t>(manifold->getNumContacts());
        }
        return points;
    }

  private:
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broadphase_;
    btCollisionWorld world_;
    Body moving_, still_;
};

} // namespace

compare::Made compare::make_bullet(const Mesh &moving, const Mesh &still)
{
    return std::make_unique<Bullet>(moving, still);
}
