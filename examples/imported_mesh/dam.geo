// The 62.5 m dam of ../reference_dam.toml on its rock, without curtain: quadrilaterals with some triangles among them.
// x downstream, y up, heel at the origin, metres. Made into a mesh by
//   gmsh -2 -format msh41 dam.geo -o dam.msh
fine = 1.5;    // along the base
dam = 3;       // in the dam
far = 25;      // at the edges of the rock

Point(1) = {0, 0, 0, fine};        // heel
Point(2) = {45, 0, 0, fine};       // toe
Point(3) = {12, 51.5, 0, dam};
Point(4) = {12, 62.5, 0, dam};
Point(5) = {0, 62.5, 0, dam};
Point(6) = {-127.5, 0, 0, far};
Point(7) = {-127.5, -100, 0, far};
Point(8) = {172.5, -100, 0, far};
Point(9) = {172.5, 0, 0, far};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 1};
Line(6) = {1, 6};
Line(7) = {6, 7};
Line(8) = {7, 8};
Line(9) = {8, 9};
Line(10) = {9, 2};

Curve Loop(1) = {1, 2, 3, 4, 5};
Curve Loop(2) = {6, 7, 8, 9, 10, -1};
Plane Surface(1) = {1};
Plane Surface(2) = {2};

Physical Surface("dam") = {1};
Physical Surface("rock") = {2};
Physical Curve("base") = {1};          // the only line that has to be named; dam and rock share its nodes
Physical Curve("downstream") = {2, 3};
Physical Curve("crest") = {4};
Physical Curve("upstream") = {5};

Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 0;       // leaves triangles
Recombine Surface{1, 2};
