%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%

MODULE arc_welding
  ! Schweißprogramm für den Rahmen – Naht 1 bis 3
  CONST robtarget pA10:=[[1005.2,-120.7,640.11],[0.21,0.67,-0.67,0.239],[-1,0,-1,0],[0,0,9E9,9E9,9E9,9E9]];
  CONST robtarget pA20:=[[1105.2,-120.7,640.11],[0.21,0.67,-0.67,0.239],[-1,0,-1,0],[0,0,9E9,9E9,9E9,9E9]];
  CONST robtarget pA30:=[[1155.2,-70.7,640.11],[0.21,0.67,-0.67,0.239],[-1,0,-1,0],[0,0,9E9,9E9,9E9,9E9]];
  TASK PERS seamdata seam1:=[0.5,0.3,[5,0,24,120,0,0,0,0,0],0.3,0,0,0,0,[0,0,0,0,0,0,0,0,0],0,0,[0,0,0,0,0,0,0,0,0],0,0,[0,0,0,0,0,0,0,0,0],0.5];
  TASK PERS welddata weld1:=[10,0,[5,0,24,180,0,0,0,0,0],[0,0,0,0,0,0,0,0,0]];
  TASK PERS weavedata weave1:=[1,0,2,3,0,0,0,0,0,0,0,0,0,0,0];
  PERS tooldata tTorch:=[TRUE,[[-12.1,0,355.2],[0.92388,0,0.382683,0]],[4.5,[-10,0,120],[1,0,0,0],0,0,0]];
  PERS pose peOffset:=[[0,0,0],[1,0,0,0]];
  PROC main()
    MoveJ Offs(pA10,0,0,100),vmax,z20,tTorch;
    ArcLStart pA10,v100,seam1,weld1\Weave:=weave1,fine,tTorch\WObj:=wobj0;
    ArcL pA20,v100,seam1,weld1\Weave:=weave1,z1,tTorch\WObj:=wobj0;
    ArcCEnd RelTool(pA20,25,5,0),pA30,v100,seam1,weld1\Weave:=weave1,fine,tTorch\WObj:=wobj0;
    MoveL Offs(pA30,0,0,100),v500,z20,tTorch;
    Search_1D peOffset,pA10,pA20,v50,tTorch;
  ENDPROC
ENDMODULE
