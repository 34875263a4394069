#pragma once

/// Root of the source tree, without a slash at the end: where tests find examples, records and documents.
/// It is a function, so that only one file of the tests knows where the tree lies.
const char* source_dir();
