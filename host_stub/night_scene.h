// The stub host's own picture: sky, stars, sea, land, in cd/m2 and then in 8-bit codes, with a true depth
// buffer. No light of any lamp is in it and none is reflected in its water: lights are the plug-in's.
#pragma once

#include <memory>

#include "host_stub/camera.h"
#include "host_stub/scene.h"

namespace seaglare::host {

// One moment of a scene.
struct Moment {
    double time_s = 0;        // for the waves
    double local_time_h = 0;  // for sun, moon and stars
    glm::dvec2 position_m{};  // of the observer: where towns glow
};

// The luminance to which `L` of the scene is drawn: key(La)/La, "photographic tone reproduction", Reinhard et
// al. 2002, with the automatic key of Krawczyk, Myszkowski and Seidel 2005 (1.002 in place of 1.03, so that
// the key of the darkest night is 0.002 and not 0.03: night stays night).
double exposure_per_cd_m2(double adaptation_cd_m2);

class NightScene {
  public:
    // Needs a GL 3.3 context, as every member and the destructor do. Throws GlFailure.
    explicit NightScene(const Scene& scene);
    ~NightScene();

    // Sets sky and adaptation for this moment; cheap when sun, moon and observer have hardly moved.
    void set_moment(const Moment& moment);
    // The scene's own value, or that of the sky.
    double adaptation_luminance_cd_m2() const;
    double sun_elevation_deg() const;
    double moon_elevation_deg() const;  // -90 without a moon

    // Clears and draws into the framebuffer that is bound; viewport is the channel's size from (0, 0). Leaves
    // depth test, program, vertex array and textures at their defaults.
    void draw(const Camera& camera, const Channel& channel);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace seaglare::host
