//! E03: values.

super::kinds! {
    301 NO_VALUE {
        title: "an expression has no value",
        help: "A division by zero, the root of a negative number, a result too large to be a number: the\n\
             caret shows the part of the expression that is to blame.",
        wrong: "print sqrt(-1)",
        right: "print sqrt(1)",
    }
    302 NO_DIRECTION {
        title: "two points coincide, so that there is no direction",
        help: "An angle, a line or an instant centre needs points that are apart.",
        wrong: "point A = (1, 1), B = (1, 1)\nprint angle(A, B)",
        right: "point A = (1, 1), B = (2, 1)\nprint angle(A, B)",
    }
    303 MIXED_SORTS {
        title: "a number where a vector is expected, or a vector where a number is",
        help: "A point's name is its position, a vector. `.x` and `.y` are numbers, so are\n\
             `distance(P, Q)` and `norm(v)`. A number times a vector and a vector plus a vector are\n\
             vectors; nothing else mixes.",
        wrong: "point A = (3, 4)\nprint A + 1",
        right: "point A = (3, 4)\nprint A + (1, 1), A.x + 1",
    }
    304 NOT_A_DRIVER {
        title: "a value that follows from the motion cannot drive it",
        help: "Velocities, accelerations and residuals follow from the constraints. They can be printed,\n\
             asserted and recorded.",
        wrong: "point A = (0, 0), B = (1, 0)\nlength A B = norm(velocity(B))",
        right: "point A = (0, 0), B = (1, 0)\nprint norm(velocity(B))",
    }
    305 OUT_OF_RANGE {
        title: "a number outside of what makes sense here",
        help: "The caret's line says what is expected.",
        wrong: "set dt 0",
        right: "set dt 1/60",
    }
    306 NOT_MEASURED {
        title: "a measure has no value yet",
        help: "`measure` takes the pose of now if it is solved, and then a value each frame; `reset` empties\n\
             it. A measure has `.min`, `.max`, `.span`, `.mean`, `.first`, `.last`, `.at_min`, `.at_max`\n\
             and `.count`.",
        wrong: "point A = (0, 0), B = (1, 0)\nlength A B = 2\nmeasure d = B.x\nprint d.max",
        right: "point A = (0, 0), B = (1, 0)\nlength A B = 2\nmeasure d = B.x\nstep\nprint d.max",
    }
}
