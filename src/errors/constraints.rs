//! E04: constraints.

super::kinds! {
    401 NONSENSE_VALUE {
        title: "a value that this constraint cannot have",
        help: "No pose has a negative length, a ratio of 0 or a range whose lower end is above the upper.",
        wrong: "point A = (0, 0), B = (1, 0)\nlength A B = -1",
        right: "point A = (0, 0), B = (1, 0)\nlength A B = 1",
    }
    402 DEGENERATE {
        title: "the points of a constraint ask for nothing, or for nonsense",
        help: "One point named twice has no distance from itself, and a line is parallel to itself.",
        wrong: "point A = (0, 0), B = (1, 0)\nlength A A = 1",
        right: "point A = (0, 0), B = (1, 0)\nlength A B = 1",
    }
    403 HOLDS_NOTHING {
        title: "a constraint in which no point has a part",
        help: "A constraint moves points. To look whether something is so, use `assert`.",
        wrong: "hold 1 + 1 = 2",
        right: "assert 1 + 1 = 2",
    }
    404 NO_SUCH_PART {
        title: "`change` names a part that this constraint does not have",
        help: "`show NAME` prints the statement; what stands behind the points can be changed.",
        wrong: "point A = (0, 0), B = (1, 0)\nrod: length A B\nchange rod speed 2",
        right: "point A = (0, 0), B = (1, 0)\nrod: length A B\nchange rod = 2",
    }
    405 NO_TOUCH {
        title: "these two cannot touch",
        help: "A line touches a circle or an arc, and two circles or arcs touch each other.",
        wrong: "point A = (0, 0), B = (1, 0), C = (0, 1), D = (1, 1)\ntangent A B to C D",
        right: "point A = (0, 0), B = (1, 0), O = (0, 2)\ncircle c = O radius 1\ntangent A B to c",
    }
    406 NO_COMMON_POINT {
        title: "a common direction is asked for where there is no common point",
        help: "`tangent ... at P` holds the direction at P, which has to be on both: as the end of an arc,\n\
             a point of the line, or a glider.",
        wrong: "point A = (0, 0), B = (1, 0), O = (0, 1), P = (5, 5)\n\
             circle c = O radius 1\ntangent A B to c at P",
        right: "point A = (0, 0), B = (1, 0), O = (0, 1)\n\
             circle c = O radius 1\ntangent A B to c",
    }
}
