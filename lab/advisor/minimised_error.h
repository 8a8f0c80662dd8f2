// The error that the automatic choice minimises (render::MinimisedError), as a number that is proportional to noise.
//
// Predictions add the squares of independent errors and divide noise by the square root of the number of samples. FLIP is
// not proportional to noise, because its colour difference is raised to the power 0.7 [Andersson et al. 2020]. It is
// therefore represented by FLIP^(1/0.7), and converted for display only. The other measures are represented by themselves.
#pragma once
#include <string>

#include "advisor/class_energy.h"
#include "advisor/true_error.h"
#include "film/error_measure.h"
#include "render/document.h"

namespace etendue::advisor {

// The error as people know it.
double shown_error(render::MinimisedError measure, double error);
// Its name within a sentence, and its value with three digits.
const char* minimised_label(render::MinimisedError measure);
std::string minimised_text(render::MinimisedError measure, double error);

// The error of a film, from its two half-buffers.
film::MeasuredError measured_error(const film::Film& film, render::MinimisedError measure,
                                   const film::DisplayTransform& display);

// The squared error of one film, from an independent one of the same size.
MeanSquare squared_error(const film::Film& film, const film::Film& other, render::MinimisedError measure,
                         const film::DisplayTransform& display);

// The squared error of an image that lacks the energy of some paths. `document` is that of both images.
double missing_square(const ClassEnergy& missing, const ClassEnergy& total, const render::Document& document,
                      render::MinimisedError measure);

}  // namespace etendue::advisor
