/* SPDX-License-Identifier: MIT */
/* ODE: its quick stepper with its default settings. */
#include "heaps.hpp"
#include "ode.hpp"

namespace
{

using namespace heaps;

constexpr int POINTS = 8;

dSurfaceParameters rough()
{
    dSurfaceParameters surface = {};

    surface.mode = dContactApprox1;
    surface.mu = FRICTION;
    return surface;
}

class Ode : private ode::Library, public Heap
{
  public:
    explicit Ode(const std::vector<Start> &boxes)
        : world_(dHashSpaceCreate(nullptr), POINTS, rough())
    {
        dMass mass;

        dMassSetBox(&mass, 1, 1, 1, 1);
        dWorldSetGravity(world_.world(), 0, 0, GRAVITY);
        dCreatePlane(world_.space(), 0, 0, 1, 0);
        for (const Start &start : boxes) {
            const dBodyID body = dBodyCreate(world_.world());
            const dGeomID geom = dCreateBox(world_.space(), 1, 1, 1);

            dBodySetMass(body, &mass);
            dGeomSetBody(geom, body);
            dBodySetPosition(body, start.position[0], start.position[1], start.position[2]);
            dBodySetQuaternion(body, start.quaternion);
            bodies_.push_back(body);
        }
    }
    const char *name() const override
    {
        return "ode";
    }
    void step() override
    {
        world_.step(STEP);
    }
    double height(int box) const override
    {
        return dBodyGetPosition(bodies_[static_cast<size_t>(box)])[2];
    }

  private:
    ode::World world_;
    std::vector<dBodyID> bodies_;
};

} // namespace

heaps::Made heaps::make_ode(const std::vector<Start> &boxes)
{
    return std::make_unique<Ode>(boxes);
}
