/* SPDX-License-Identifier: MIT */
/* ODE: the scene `head` of two trimeshes, a contact joint at each point that it finds. */
#include <ode/ode.h>

#include "heaps.hpp"

namespace
{

using namespace heaps;

constexpr int POINTS = 64;

struct Library {
    Library()
    {
        static const int once = dInitODE2(0);

        (void)once;
    }
};

class Ode : private Library, public Heap
{
  public:
    explicit Ode(const Scene &scene)
        : scene_(scene), world_(dWorldCreate()), space_(dSimpleSpaceCreate(nullptr)),
          joints_(dJointGroupCreate(0)), body_(dBodyCreate(world_))
    {
        const double *i = scene_.inertia, *q = scene_.start.quaternion;
        const double *x = scene_.start.position, *v = scene_.velocity, *w = scene_.spin;
        dMass mass;

        dWorldSetGravity(world_, 0, 0, GRAVITY);
        dMassSetParameters(&mass, 1, 0, 0, 0, i[0], i[1], i[2], i[3], i[5], i[4]);
        dBodySetMass(body_, &mass);
        add(scene_.field);
        dGeomSetBody(add(scene_.head), body_);
        dBodySetPosition(body_, x[0], x[1], x[2]);
        dBodySetQuaternion(body_, q);
        dBodySetLinearVel(body_, v[0], v[1], v[2]);
        dBodySetAngularVel(body_, w[0], w[1], w[2]);
    }
    ~Ode() override
    {
        dJointGroupDestroy(joints_);
        dSpaceDestroy(space_);
        dWorldDestroy(world_);
        for (dTriMeshDataID data : data_) {
            dGeomTriMeshDataDestroy(data);
        }
    }
    Ode(const Ode &) = delete;
    Ode &operator=(const Ode &) = delete;
    const char *name() const override
    {
        return "ode";
    }
    void step() override
    {
        dSpaceCollide(space_, this, near);
        dWorldQuickStep(world_, STEP);
        dJointGroupEmpty(joints_);
    }
    double height(int) const override
    {
        return dBodyGetPosition(body_)[2];
    }

  private:
    const Scene scene_;
    dWorldID world_;
    dSpaceID space_;
    dJointGroupID joints_;
    dBodyID body_;
    std::vector<dTriMeshDataID> data_;

    dGeomID add(const Mesh &mesh)
    {
        data_.push_back(dGeomTriMeshDataCreate());
        dGeomTriMeshDataBuildSingle(data_.back(), mesh.vertices.data(), sizeof mesh.vertices[0],
                                    static_cast<int>(mesh.vertices.size()), mesh.faces.data(),
                                    static_cast<int>(3 * mesh.faces.size()), sizeof mesh.faces[0]);
        return dCreateTriMesh(space_, data_.back(), nullptr, nullptr, nullptr);
    }
    static void near(void *self, dGeomID a, dGeomID b)
    {
        Ode *ode = static_cast<Ode *>(self);
        dContact contacts[POINTS] = {};
        const int n = dCollide(a, b, POINTS, &contacts[0].geom, sizeof contacts[0]);

        for (int i = 0; i < n; i++) {
            contacts[i].surface.mode = dContactApprox1 | dContactBounce;
            contacts[i].surface.mu = ode->scene_.friction;
            contacts[i].surface.bounce = ode->scene_.restitution;
            dJointAttach(dJointCreateContact(ode->world_, ode->joints_, &contacts[i]),
                         dGeomGetBody(a), dGeomGetBody(b));
        }
    }
};

} // namespace

heaps::Made heaps::make_ode_head(const Scene &scene)
{
    return std::make_unique<Ode>(scene);
}
