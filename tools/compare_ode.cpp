/* SPDX-License-Identifier: MIT */
/* ODE: two trimesh geoms, through its test of boxes to contact points. */
#include "compare.hpp"
#include "ode.hpp"

namespace
{

using namespace compare;

/* ODE tests every pair of faces, however many points there is room for. */
constexpr int POINTS = 64;

struct Trimesh {
    std::vector<float> vertices; /* ODE converts to float anyway; floats are 5 % faster than
                                  * doubles */
    std::vector<dTriIndex> indices;
    dTriMeshDataID data;
    dGeomID geom;

    explicit Trimesh(const Mesh &mesh)
    {
        for (const auto &v : mesh.vertices) {
            vertices.insert(vertices.end(), v.begin(), v.end());
        }
        for (const auto &face : mesh.faces) {
            indices.insert(indices.end(), face.begin(), face.end());
        }
        data = dGeomTriMeshDataCreate();
        dGeomTriMeshDataBuildSingle(data, vertices.data(), 3 * sizeof(float),
                                    static_cast<int>(mesh.vertices.size()), indices.data(),
                                    static_cast<int>(indices.size()), 3 * sizeof(dTriIndex));
        geom = dCreateTriMesh(nullptr, data, nullptr, nullptr, nullptr);
    }
    ~Trimesh()
    {
        dGeomDestroy(geom);
        dGeomTriMeshDataDestroy(data);
    }
    Trimesh(const Trimesh &) = delete;
    Trimesh &operator=(const Trimesh &) = delete;
};

class Ode : private ode::Library, public Contender
{
  public:
    Ode(const Mesh &moving, const Mesh &still) : moving_(moving), still_(still)
    {
    }
    const char *name() const override
    {
        return "ode";
    }
    void place(const Pose &pose) override
    {
        dGeomSetPosition(moving_.geom, pose.position[0], pose.position[1], pose.position[2]);
        dGeomSetQuaternion(moving_.geom, pose.quaternion);
    }
    void query() override
    {
        count_ = 0;
        dSpaceCollide2(moving_.geom, still_.geom, this, near);
    }
    size_t found() const override
    {
        return static_cast<size_t>(count_);
    }

  private:
    Trimesh moving_, still_;
    dContactGeom points_[POINTS];
    int count_ = 0;

    static void near(void *self, dGeomID a, dGeomID b)
    {
        Ode *ode = static_cast<Ode *>(self);

        ode->count_ = dCollide(a, b, POINTS, ode->points_, sizeof(dContactGeom));
    }
};

} // namespace

compare::Made compare::make_ode(const Mesh &moving, const Mesh &still)
{
    return std::make_unique<Ode>(moving, still);
}
