! RAPID Kernel, Orientations: four zeros turn nothing, and no function computes with them.
MODULE no_orientation
  VAR orient none;
  VAR orient turned:=[1,0,0,0];
  VAR num angle;

  PROC main()
    turned:=none*turned;
    angle:=EulerZYX(\Z,none);
    turned:=NOrient(none);
    TPWrite "end";                      ! -> end
  ERROR
    TPWrite "illegal "\Bool:=ERRNO=ERR_ILLQUAT;
    ! -> illegal TRUE
    ! -> illegal TRUE
    ! -> illegal TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
