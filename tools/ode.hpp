/* SPDX-License-Identifier: MIT */
/*
 * ode - the common part of all tools with ODE: the library, initialised once; a world that steps
 * with contact joints.
 */
#ifndef CAROM_TOOLS_ODE_HPP
#define CAROM_TOOLS_ODE_HPP

#include <vector>

#include <ode/ode.h>

namespace ode
{

/* Initialise the library before its first object. */
struct Library {
    Library()
    {
        static const int once = dInitODE2(0);

        (void)once;
    }
};

/* A world whose bodies touch by contact joints: so many points a pair, with one surface for all. */
class World : private Library
{
  public:
    World(dSpaceID space, int points, const dSurfaceParameters &surface)
        : world_(dWorldCreate()), space_(space), joints_(dJointGroupCreate(0)), surface_(surface),
          contacts_(static_cast<size_t>(points))
    {
    }
    ~World()
    {
        dJointGroupDestroy(joints_);
        dSpaceDestroy(space_);
        dWorldDestroy(world_);
    }
    World(const World &) = delete;
    World &operator=(const World &) = delete;
    dWorldID world() const
    {
        return world_;
    }
    dSpaceID space() const
    {
        return space_;
    }
    void step(double seconds)
    {
        dSpaceCollide(space_, this, near);
        dWorldQuickStep(world_, seconds);
        dJointGroupEmpty(joints_);
    }

  private:
    dWorldID world_;
    dSpaceID space_;
    dJointGroupID joints_;
    dSurfaceParameters surface_;
    std::vector<dContact> contacts_;

    static void near(void *self, dGeomID a, dGeomID b)
    {
        World *ode = static_cast<World *>(self);
        std::vector<dContact> &contacts = ode->contacts_;
        const int n = dCollide(a, b, static_cast<int>(contacts.size()), &contacts[0].geom,
                               sizeof contacts[0]);

        for (int i = 0; i < n; i++) {
            dContact &contact = contacts[static_cast<size_t>(i)];

            contact.surface = ode->surface_;
            dJointAttach(dJointCreateContact(ode->world_, ode->joints_, &contact), dGeomGetBody(a),
                         dGeomGetBody(b));
        }
    }
};

} // namespace ode

#endif
