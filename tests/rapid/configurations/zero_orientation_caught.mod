! RAPID Overview, Targets: a clause may see to a target that nobody has taught.
MODULE zero_orientation_caught
  VAR robtarget taught;

  PROC main()
    taught.trans:=[700,0,600];
    taught.extax:=[9E9,9E9,9E9,9E9,9E9,9E9];
    MoveJ taught,v500,fine,tool0;
    TPWrite "there "\Pos:=CPos(\Tool:=tool0);    ! -> there [700,0,600]
  ERROR
    TPWrite "teach it";                 ! -> teach it
    taught.rot:=[0,0,1,0];
    RETRY;
  ENDPROC
ENDMODULE
