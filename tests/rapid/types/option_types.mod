! RAPID Overview, Options: types of options belong to the controller that has the option.
MODULE option_types
  PERS beaddata seam1:=[1,2,[0,0]];
  PERS beaddata seam2:=[3,4,[5,6]];

  PROC main()
    seam1:=seam2;
    TPWrite "loaded";                 ! -> loaded
  ENDPROC
ENDMODULE
