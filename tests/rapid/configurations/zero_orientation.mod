! RAPID Overview, Targets: a move to a target without an orientation stops the program.
MODULE zero_orientation
  VAR robtarget nowhere;

  PROC main()
    nowhere.trans:=[700,0,600];
    MoveJ nowhere,v500,fine,tool0;      ! error: M501
  ENDPROC
ENDMODULE
