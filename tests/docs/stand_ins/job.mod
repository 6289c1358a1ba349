MODULE job
  ! What pages call `job.mod`, the reader's own program: short, for it runs often.
  PERS num nDone:=0;
  PROC main()
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
    MoveJ [[800,-100,900],[0.5,0,0.8660254,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, z10, tool0;
    MoveL [[800,100,900],[0.5,0,0.8660254,0],[0,-1,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
    nDone:=nDone+1;
  ENDPROC
ENDMODULE
