// The list of cases, ordered by kind: one include and one line per case.
#include "stress/case.h"
#include "stress/cases/albedo_of_one.h"
#include "stress/cases/all_scales.h"
#include "stress/cases/camera_in_a_medium.h"
#include "stress/cases/camera_inside_glass.h"
#include "stress/cases/caustic_behind_glass.h"
#include "stress/cases/caustic_of_a_point_light.h"
#include "stress/cases/caustic_of_a_small_light.h"
#include "stress/cases/chains_in_two_places.h"
#include "stress/cases/closed_room_of_albedo_one.h"
#include "stress/cases/coincident_lights.h"
#include "stress/cases/concave_patches.h"
#include "stress/cases/depth_cut_off.h"
#include "stress/cases/diffusion_in_a_thin_slab.h"
#include "stress/cases/emitter_that_reflects.h"
#include "stress/cases/far_from_the_origin.h"
#include "stress/cases/form_factors_at_an_edge.h"
#include "stress/cases/glossy_virtual_lights.h"
#include "stress/cases/grazing_albedo.h"
#include "stress/cases/grazing_light.h"
#include "stress/cases/grille_as_fine_as_pixels.h"
#include "stress/cases/hall_of_mirrors.h"
#include "stress/cases/heterogeneous_furnace.h"
#include "stress/cases/index_of_one.h"
#include "stress/cases/infinite_emission.h"
#include "stress/cases/integrating_sphere.h"
#include "stress/cases/inverted_normals.h"
#include "stress/cases/late_dimensions.h"
#include "stress/cases/lens_of_no_size.h"
#include "stress/cases/lens_too_small_to_hit.h"
#include "stress/cases/light_from_one_patch.h"
#include "stress/cases/light_in_a_sphere.h"
#include "stress/cases/light_of_a_micrometre.h"
#include "stress/cases/light_that_touches_a_wall.h"
#include "stress/cases/light_through_a_gap.h"
#include "stress/cases/lossless_glass.h"
#include "stress/cases/many_lights.h"
#include "stress/cases/models_at_their_ends.h"
#include "stress/cases/models_that_make_light.h"
#include "stress/cases/nan_in_a_sky.h"
#include "stress/cases/narrow_lobe_and_small_light.h"
#include "stress/cases/narrow_phase_functions.h"
#include "stress/cases/nested_glass.h"
#include "stress/cases/optical_depth.h"
#include "stress/cases/photons_at_a_shadow.h"
#include "stress/cases/photons_at_an_edge.h"
#include "stress/cases/photons_in_an_estimate.h"
#include "stress/cases/photons_on_a_ball.h"
#include "stress/cases/photons_too_few.h"
#include "stress/cases/point_light_unseen.h"
#include "stress/cases/point_on_the_light.h"
#include "stress/cases/radiosity_light_leaks.h"
#include "stress/cases/radiosity_reflectance_to_one.h"
#include "stress/cases/radiosity_relaxation_factor.h"
#include "stress/cases/radiosity_slivers.h"
#include "stress/cases/reused_seeds.h"
#include "stress/cases/room_that_makes_light.h"
#include "stress/cases/roughness_at_its_ends.h"
#include "stress/cases/roulette_below_the_square.h"
#include "stress/cases/roulette_of_a_bright_room.h"
#include "stress/cases/scattering_furnace.h"
#include "stress/cases/seeds_and_pixels.h"
#include "stress/cases/settings_that_are_no_numbers.h"
#include "stress/cases/shadows_ignored.h"
#include "stress/cases/shutter_of_no_time.h"
#include "stress/cases/sixteen_nested_solids.h"
#include "stress/cases/slivers.h"
#include "stress/cases/small_light_by_chance.h"
#include "stress/cases/starts_of_chains.h"
#include "stress/cases/table_of_a_model.h"
#include "stress/cases/thirty_stops.h"
#include "stress/cases/total_reflection.h"
#include "stress/cases/triangles_without_area.h"
#include "stress/cases/view_of_a_small_part.h"
#include "stress/cases/virtual_lights_in_a_corner.h"

namespace etendue::stress {

std::string_view kind_name(Kind kind) {
  switch (kind) {
    case Kind::missing_paths:
      return "blind spots";
    case Kind::heavy_tails:
      return "heavy tails";
    case Kind::bias:
      return "bias";
    case Kind::correlation:
      return "correlation";
    case Kind::parameters:
      return "limits of parameters";
    case Kind::geometry:
      return "limits of geometry";
    case Kind::broken_physics:
      return "broken physics";
    case Kind::invalid_numbers:
      return "bad numbers";
  }
  return "";
}

std::string_view kind_label(Kind kind) {
  switch (kind) {
    case Kind::missing_paths:
      return "Missing light paths";
    case Kind::heavy_tails:
      return "Heavy-tailed estimators";
    case Kind::bias:
      return "Bias";
    case Kind::correlation:
      return "Correlated samples";
    case Kind::parameters:
      return "Limits of parameters";
    case Kind::geometry:
      return "Limits of geometry";
    case Kind::broken_physics:
      return "Models that do not conserve energy";
    case Kind::invalid_numbers:
      return "NaN and infinity";
  }
  return "";
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      kCausticOfAPointLight,
      kCausticBehindGlass,
      kPointLightUnseen,
      kLensTooSmallToHit,
      kIntegratingSphere,
      kSmallLightByChance,
      kLightInASphere,
      kCausticOfASmallLight,
      kLightFromOnePatch,
      kLightThroughAGap,
      kViewOfASmallPart,
      kNarrowLobeAndSmallLight,
      kLightThatTouchesAWall,
      kRouletteBelowTheSquare,
      kFormFactorsAtAnEdge,
      kShadowsIgnored,
      kManyLights,
      kEmitterThatReflects,
      kGrilleAsFineAsPixels,
      kDepthCutOff,
      kDiffusionInAThinSlab,
      kRouletteOfABrightRoom,
      kStartsOfChains,
      kChainsInTwoPlaces,
      kVirtualLightsInACorner,
      kGlossyVirtualLights,
      kPhotonsAtAnEdge,
      kPhotonsAtAShadow,
      kPhotonsOnABall,
      kRadiosityLightLeaks,
      kSeedsAndPixels,
      kReusedSeeds,
      kLateDimensions,
      kHallOfMirrors,
      kIndexOfOne,
      kLosslessGlass,
      kTotalReflection,
      kRoughnessAtItsEnds,
      kModelsAtTheirEnds,
      kAlbedoOfOne,
      kClosedRoomOfAlbedoOne,
      kOpticalDepth,
      kScatteringFurnace,
      kNarrowPhaseFunctions,
      kHeterogeneousFurnace,
      kPhotonsInAnEstimate,
      kPhotonsTooFew,
      kLightOfAMicrometre,
      kThirtyStops,
      kLensOfNoSize,
      kShutterOfNoTime,
      kRadiosityReflectanceToOne,
      kRadiosityRelaxationFactor,
      kAllScales,
      kFarFromTheOrigin,
      kSlivers,
      kCoincidentLights,
      kInvertedNormals,
      kCameraInsideGlass,
      kCameraInAMedium,
      kNestedGlass,
      kSixteenNestedSolids,
      kTrianglesWithoutArea,
      kGrazingLight,
      kPointOnTheLight,
      kRadiositySlivers,
      kConcavePatches,
      kGrazingAlbedo,
      kModelsThatMakeLight,
      kRoomThatMakesLight,
      kTableOfAModel,
      kInfiniteEmission,
      kNanInASky,
      kSettingsThatAreNoNumbers,
  };
  return all;
}

const Case* find_case(std::string_view name) {
  // Former names remain valid.
  if (name == "lamp-in-a-sphere") name = "light-in-a-sphere";
  if (name == "caustic-of-a-small-lamp") name = "caustic-of-a-small-light";
  for (const Case& c : cases())
    if (c.name == name) return &c;
  return nullptr;
}

}  // namespace etendue::stress
