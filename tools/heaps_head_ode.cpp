/* SPDX-License-Identifier: MIT */
/* ODE: the scene `head` of two trimeshes, with a contact joint at each point found. */
#include "heaps.hpp"
#include "ode.hpp"

namespace
{

using namespace heaps;

constexpr int POINTS = 64;

dSurfaceParameters surface_of(const Scene &scene)
{
    dSurfaceParameters surface = {};

    surface.mode = dContactApprox1 | dContactBounce;
    surface.mu = scene.friction;
    surface.bounce = scene.restitution;
    return surface;
}

/* The data of the meshes, which geoms refer to. */
struct Meshes {
    std::vector<dTriMeshDataID> data;

    ~Meshes()
    {
        for (dTriMeshDataID each : data) {
            dGeomTriMeshDataDestroy(each);
        }
    }
};

class Ode : private ode::Library, public Heap
{
  public:
    explicit Ode(const Scene &scene)
        : scene_(scene), world_(dSimpleSpaceCreate(nullptr), POINTS, surface_of(scene)),
          body_(dBodyCreate(world_.world()))
    {
        const double *i = scene_.inertia, *q = scene_.start.quaternion;
        const double *x = scene_.start.position, *v = scene_.velocity, *w = scene_.spin;
        dMass mass;

        dWorldSetGravity(world_.world(), 0, 0, GRAVITY);
        dMassSetParameters(&mass, 1, 0, 0, 0, i[0], i[1], i[2], i[3], i[5], i[4]);
        dBodySetMass(body_, &mass);
        add(scene_.field);
        dGeomSetBody(add(scene_.head), body_);
        dBodySetPosition(body_, x[0], x[1], x[2]);
        dBodySetQuaternion(body_, q);
        dBodySetLinearVel(body_, v[0], v[1], v[2]);
        dBodySetAngularVel(body_, w[0], w[1], w[2]);
    }
    const char *name() const override
    {
        return "ode";
    }
    void step() override
    {
        world_.step(STEP);
    }
    double height(int) const override
    {
        return dBodyGetPosition(body_)[2];
    }

  private:
    const Scene scene_;
    Meshes meshes_; /* must outlive the world */
    ode::World world_;
    dBodyID body_;

    dGeomID add(const Mesh &mesh)
    {
        const dTriMeshDataID data = dGeomTriMeshDataCreate();

        meshes_.data.push_back(data);
        dGeomTriMeshDataBuildSingle(data, mesh.vertices.data(), sizeof mesh.vertices[0],
                                    static_cast<int>(mesh.vertices.size()), mesh.faces.data(),
                                    static_cast<int>(3 * mesh.faces.size()), sizeof mesh.faces[0]);
        return dCreateTriMesh(world_.space(), data, nullptr, nullptr, nullptr);
    }
};

} // namespace

heaps::Made heaps::make_ode_head(const Scene &scene)
{
    return std::make_unique<Ode>(scene);
}
