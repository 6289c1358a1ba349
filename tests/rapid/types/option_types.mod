! RAPID Overview, Options: a type that no module declares belongs to an option and loads.
MODULE option_types
  PERS beaddata seam1:=[1,2,[0,0]];   ! warning: N210
  PERS beaddata seam2:=[3,4,[5,6]];   ! warning: N210

  PROC main()
    seam1:=seam2;
    TPWrite "loaded";                 ! -> loaded
  ENDPROC
ENDMODULE
