#pragma once

#include "cli/verifier.hpp"

#include <span>

/// What damslip-verify does for the commands that damslip hands on.
namespace damslip::cli {

/// Runs verification cases, hard cases, or the results of others. @returns exit_ok when they pass, else exit_no_answer
int verify(const VerifyArguments& arguments, const Streams& streams);

/// Chapter 4 of Goldgruber (2015): rows, findings, page.
int study(const StudyArguments& arguments, const Streams& streams);

/// Writes the model as a deck for CalculiX, or holds its results beside ours. @returns exit_no_answer where one lies outside
int calculix(const MeshArguments& arguments, const Streams& streams);

/// verify, study and mesh.
std::span<const Command> verifier_commands();

} // namespace damslip::cli
