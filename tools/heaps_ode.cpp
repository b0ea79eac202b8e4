/* SPDX-License-Identifier: MIT */
/* ODE: its quick stepper with the settings it comes with. */
#include <ode/ode.h>

#include "heaps.hpp"

namespace
{

using namespace heaps;

constexpr int POINTS = 8;

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
    explicit Ode(const std::vector<Start> &boxes)
        : world_(dWorldCreate()), space_(dHashSpaceCreate(nullptr)), joints_(dJointGroupCreate(0))
    {
        dMass mass;

        dMassSetBox(&mass, 1, 1, 1, 1);
        dWorldSetGravity(world_, 0, 0, GRAVITY);
        dCreatePlane(space_, 0, 0, 1, 0);
        for (const Start &start : boxes) {
            const dBodyID body = dBodyCreate(world_);
            const dGeomID geom = dCreateBox(space_, 1, 1, 1);

            dBodySetMass(body, &mass);
            dGeomSetBody(geom, body);
            dBodySetPosition(body, start.position[0], start.position[1], start.position[2]);
            dBodySetQuaternion(body, start.quaternion);
            bodies_.push_back(body);
        }
    }
    ~Ode() override
    {
        dJointGroupDestroy(joints_);
        dSpaceDestroy(space_);
        dWorldDestroy(world_);
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
    double height(int box) const override
    {
        return dBodyGetPosition(bodies_[static_cast<size_t>(box)])[2];
    }

  private:
    dWorldID world_;
    dSpaceID space_;
    dJointGroupID joints_;
    std::vector<dBodyID> bodies_;

    static void near(void *self, dGeomID a, dGeomID b)
    {
        Ode *ode = static_cast<Ode *>(self);
        dContact contacts[POINTS] = {};
        const int n = dCollide(a, b, POINTS, &contacts[0].geom, sizeof contacts[0]);

        for (int i = 0; i < n; i++) {
            contacts[i].surface.mode = dContactApprox1;
            contacts[i].surface.mu = FRICTION;
            dJointAttach(dJointCreateContact(ode->world_, ode->joints_, &contacts[i]),
                         dGeomGetBody(a), dGeomGetBody(b));
        }
    }
};

} // namespace

heaps::Made heaps::make_ode(const std::vector<Start> &boxes)
{
    return std::make_unique<Ode>(boxes);
}
