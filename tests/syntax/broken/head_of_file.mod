File written by cell 4 - do not edit!
MODULE head_of_file(SYSMODULE,,READONLY)
  PERS tooldata Gripper(Closed):=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  PERS num count=0;
  PROC main
    MoveJ pHome,v500,fine,Gripper(Closed);
    count:=count+1;
  ENDPROC
ENDMODULE
This is what the program does: it moves home.
It has no other purpose, "really".
